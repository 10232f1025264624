// Traces that no run wrote as they are: imported, cut out, joined, recovered. A byte that is not as
// it was written is told by whoever reads the file, as of a run's own trace. What an import holds
// cannot be simulated again: there nothing else would tell.
#include <filesystem>
#include <random>

#include <gmock/gmock.h>

#include "exchange/carla/carla_import.h"
#include "replay/recovery.h"
#include "replay/slice.h"
#include "replay/trace_reader.h"
#include "tests/exchange/carla_logs.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"

namespace reprise::test {
namespace {

using replay::TraceReader;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t ticks = 150;  // three chunks

class MadeTrace : public testing::Test {
  protected:
    MadeTrace() { write_trace(whole_, {.ticks = ticks}); }

    std::filesystem::path cut(std::uint64_t first, std::uint64_t last) {
        const auto path = folder_ / (std::to_string(first) + ".mcap");
        TraceReader trace(whole_);
        slice(trace, first, last, path);
        return path;
    }

    /// Refused, or found to be damaged, as `reprise info` and `reprise verify` look at a file.
    static bool told(const std::filesystem::path& path) {
        try {
            TraceReader trace(path);
            for (std::uint64_t index = trace.first(); index <= trace.last(); ++index)
                if (trace.damage(index))
                    return true;
            return trace.damage().has_value();
        } catch (const world::Error&) {
            return true;
        }
    }

    /// So many single bits anywhere, and one in each byte of the first and the last thousand.
    void flip(const std::filesystem::path& original) {
        ASSERT_FALSE(told(original));
        constexpr std::size_t anywhere = 400;
        constexpr std::size_t ends = 1000;
        const Bytes whole = read_file(original);
        const std::filesystem::path flipped = folder_ / "flipped.mcap";
        std::mt19937 random(13);
        for (std::size_t i = 0; i < anywhere + 2 * ends; ++i) {
            std::size_t at = random() % whole.size();
            if (i >= anywhere)
                at = i - anywhere < ends ? i - anywhere : whole.size() - (i - anywhere - ends) - 1;
            Bytes bytes = whole;
            bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << (random() % 8)));
            write_file(flipped, bytes);
            EXPECT_TRUE(told(flipped)) << "byte " << at << " of " << whole.size();
        }
    }

    Folder folder_;
    std::filesystem::path whole_ = folder_ / "whole.mcap";
};

TEST_F(MadeTrace, OfAnImportTellsEveryFlippedBit) {
    const auto path = folder_ / "imported.mcap";
    exchange::CarlaImportOptions options;
    options.name = "drive.log";
    options.timing = {50'000'000, [](double, double) { return 1.5; }};
    options.progress = [](std::uint64_t) {};
    import_carla(bytes_of(carla_log("--seconds 3")), options, path);
    flip(path);
}

TEST_F(MadeTrace, OfASliceTellsEveryFlippedBit) {
    flip(cut(40, 110));
}

TEST_F(MadeTrace, OfAMergeTellsEveryFlippedBit) {
    std::vector<TraceReader> parts;
    parts.emplace_back(cut(10, 90));
    parts.emplace_back(cut(91, ticks));
    const auto path = folder_ / "merged.mcap";
    merge(parts, path);
    flip(path);
}

TEST_F(MadeTrace, OfARecoveryTellsEveryFlippedBit) {
    Bytes bytes = read_file(whole_);
    bytes.resize(bytes.size() * 3 / 4);
    const auto damaged = folder_ / "damaged.mcap";
    write_file(damaged, bytes);
    const auto path = folder_ / "recovered.mcap";
    ASSERT_GT(replay::recover(damaged, path).outcome.ticks, 60U);
    flip(path);
}

}  // namespace
}  // namespace reprise::test
