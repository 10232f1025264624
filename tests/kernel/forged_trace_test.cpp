// Nothing in a trace may be changed with its checksums repaired and be called equal. Here: any byte
// of the file.
#include "tests/kernel/forged_trace.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "replay/mcap/mcap.h"
#include "replay/recovery.h"
#include "replay/slice.h"

namespace reprise::test {
namespace {

using replay::TraceReader;
namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

TEST_F(ForgedTrace, IsToldWhicheverByteWasChanged) {
    flip_bytes(whole_, 60);
}

TEST_F(ForgedTrace, IsToldAtEveryLevel) {
    for (const replay::Level level :
         {replay::Level::inputs, replay::Level::core, replay::Level::keyed}) {
        const auto path = folder_ / "level.mcap";
        record(path, level);
        flip_bytes(path, 12);
    }
}

TEST_F(ForgedTrace, IsToldOfABranchAndOfASlice) {
    world::BranchT branch;
    branch.tick = 3;
    branch.name = "test";
    branch.scenario_path = "test.lua";
    branch.max_ticks = 6;
    branch.parameters.push_back({});
    branch.parameters.back().key = "gap";
    branch.parameters.back().value = "2";
    const auto branched = folder_ / "branched.mcap";
    record(branched, replay::Level::full, {branch});
    flip_bytes(branched, 12);
    const auto part = folder_ / "part.mcap";
    TraceReader trace(whole_);
    slice(trace, 1, 4, part);
    flip_bytes(part, 12);
}

TEST_F(ForgedTrace, IsToldOfAMergedAndOfARecoveredTrace) {
    const auto merged = folder_ / "merged.mcap";
    {
        TraceReader trace(whole_);
        slice(trace, 1, 3, folder_ / "1.mcap");
        slice(trace, 4, 6, folder_ / "2.mcap");
        std::vector<TraceReader> parts;
        parts.emplace_back(folder_ / "1.mcap");
        parts.emplace_back(folder_ / "2.mcap");
        merge(parts, merged);
    }
    flip_bytes(merged, 12);
    Bytes bytes = read_file(whole_);
    bytes.resize(bytes.size() - mcap::tail_size);
    write_file(folder_ / "cut.mcap", bytes);
    const auto recovered = folder_ / "recovered.mcap";
    replay::recover(folder_ / "cut.mcap", recovered);
    flip_bytes(recovered, 12);
}

}  // namespace
}  // namespace reprise::test
