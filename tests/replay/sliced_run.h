#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "replay/slice.h"
#include "tests/replay/synthetic_run.h"

namespace reprise::test {

/// A run of 150 ticks in a folder of its own, to be cut and joined.
class SlicedRun : public testing::Test {
  protected:
    SlicedRun() { write_trace(whole_, {.ticks = 150}); }

    std::filesystem::path cut(std::uint64_t first, std::uint64_t last) {
        const auto path = folder_ / (std::to_string(first) + ".mcap");
        replay::TraceReader trace(whole_);
        replay::slice(trace, first, last, path);
        return path;
    }

    std::filesystem::path join(const std::vector<std::filesystem::path>& paths) {
        std::vector<replay::TraceReader> parts(paths.begin(), paths.end());
        const auto path = folder_ / "merged.mcap";
        replay::merge(parts, path);
        return path;
    }

    std::filesystem::path join(const std::filesystem::path& earlier,
                               const std::filesystem::path& later) {
        return join(std::vector{earlier, later});
    }

    std::string refusal(const std::filesystem::path& earlier, const std::filesystem::path& later) {
        return error_of([&] { join(earlier, later); });
    }

    Folder folder_;
    std::filesystem::path whole_ = folder_ / "whole.mcap";
};

}  // namespace reprise::test
