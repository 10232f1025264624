#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "replay/level.h"
#include "tests/replay/synthetic_run.h"
#include "world/recording.h"

namespace reprise::test {

/// A recorded run of six ticks, and what is made of it by somebody who repairs all checksums.
class ForgedTrace : public testing::Test {
  protected:
    ForgedTrace();

    void record(const std::filesystem::path& path,
                replay::Level level,
                const std::vector<world::BranchT>& branches = {});

    /// What verify makes of it: the difference or the refusal; "" when it calls it equal.
    static std::string verified(const std::filesystem::path& path);

    /// The same of diff against the original.
    static std::string compared(const std::filesystem::path& original,
                                const std::filesystem::path& forged);

    /// What verify would find without simulating: it refuses to open the file, or looks at its
    /// bytes. Most forgeries fail there, and a run for each takes long.
    static std::string read_through(const std::filesystem::path& path);

    /// Writes a trace anew from these parts, as the program itself would: all copies of a value
    /// agree, and all checksums.
    void write(const world::Recording& recording,
               const std::vector<TickBytes>& ticks,
               const world::Outcome& outcome);

    std::vector<TickBytes> recorded_ticks();

    /// Changes a byte in about so many places of every record, and demands that it is said.
    void flip_bytes(const std::filesystem::path& original, std::size_t of_each_record);

    const world::Recording recording_;
    Folder folder_;
    std::filesystem::path whole_ = folder_ / "whole.mcap";
    std::filesystem::path forged_ = folder_ / "forged.mcap";
};

}  // namespace reprise::test
