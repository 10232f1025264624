// Nothing in a trace may be changed with its checksums repaired and be called equal. Here: any
// value of what it holds, written anew throughout.
#include <array>

#include <gmock/gmock.h>

#include "replay/chain_seed.h"
#include "replay/noun_check.h"
#include "replay/outcomes.h"
#include "replay/trace_format.h"
#include "replay/trace_reader.h"
#include "tests/kernel/forged_trace.h"
#include "world/digest.h"

namespace reprise::test {
namespace {

using replay::TraceReader;
using testing::HasSubstr;
namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

/// Every value of the episode, changed in all places where it is, with the ticks as they were. Only
/// where the town's file lay and who recorded it are not in the chain.
TEST_F(ForgedTrace, IsToldWhicheverValueOfTheEpisodeWasChangedThroughout) {
    const std::vector<TickBytes> ticks = recorded_ticks();
    const world::Outcome outcome = TraceReader(whole_).outcome();
    const Bytes packed = replay::format::pack(recording_.episode);
    const auto labels_cut = [](world::EpisodeT episode) {
        episode.town_path.clear();
        episode.fingerprint.clear();
        return replay::format::pack(episode);
    };
    int values = 0;
    int labels = 0;
    for (std::size_t at = 0; at < packed.size(); ++at) {
        alignas(8) std::array<std::uint8_t, 4096> bytes{};
        ASSERT_LE(packed.size(), bytes.size());
        std::copy(packed.begin(), packed.end(), bytes.begin());
        bytes[at] ^= 1;
        const mcap::View view(bytes.data(), packed.size());
        if (replay::fault_of_episode(view))
            continue;
        world::Recording changed = recording_;
        world::GetEpisode(view.data())->UnPackTo(&changed.episode);
        if (replay::format::pack(changed.episode) == packed || changed.episode.step_ns < 1000)
            continue;
        const bool label = labels_cut(changed.episode) == labels_cut(recording_.episode);
        (label ? labels : values) += 1;
        EXPECT_EQ(replay::chain_seed(changed) == replay::chain_seed(recording_), label) << at;
        if (label || values % 25 != 1)
            continue;  // a run for each takes long, and the chain's start decides
        if (changed.episode.step_ns != recording_.episode.step_ns)
            continue;  // other times: the writer's own
        write(changed, ticks, outcome);
        EXPECT_NE(verified(forged_), "") << at;
        EXPECT_NE(compared(whole_, forged_), "") << at;
    }
    EXPECT_GT(values, 300);
    EXPECT_GT(labels, 20);
}

TEST_F(ForgedTrace, IsToldWhicheverByteOfTheTownOrTheNetworkWasChangedThroughout) {
    const Bytes packed = replay::format::pack(recording_.town);
    const world::Digest128 seed = replay::chain_seed(recording_);
    int changes = 0;
    for (std::size_t at = 0; at < packed.size(); at += 41) {
        std::vector<std::uint64_t> aligned(packed.size() / 8 + 1);
        auto* bytes = reinterpret_cast<std::uint8_t*>(aligned.data());
        std::copy(packed.begin(), packed.end(), bytes);
        bytes[at] ^= 1;
        if (replay::fault_of_town({bytes, packed.size()}))
            continue;
        world::Recording changed = recording_;
        changed.town = {};
        world::GetTown(bytes)->UnPackTo(&changed.town);
        if (replay::format::pack(changed.town) == packed)
            continue;
        ++changes;
        EXPECT_NE(replay::chain_seed(changed), seed) << at;
    }
    EXPECT_GT(changes, 100);
    world::Recording changed = recording_;
    changed.network += "\n";
    changed.episode.town_digest = world::digest128(changed.network);
    write(changed, recorded_ticks(), TraceReader(whole_).outcome());
    EXPECT_THAT(verified(forged_), HasSubstr("digests.chain"));
}

TEST_F(ForgedTrace, IsToldWhicheverByteOfATickWasChanged) {
    const std::vector<TickBytes> ticks = recorded_ticks();
    const world::Outcome outcome = TraceReader(whole_).outcome();
    int changes = 0;
    for (const std::size_t index : {1u, 6u}) {
        for (const bool traffic : {false, true}) {
            const Bytes& original = traffic ? ticks[index - 1].traffic : ticks[index - 1].tick;
            for (std::size_t at = 0; at < original.size(); at += original.size() / 25 + 1) {
                std::vector<TickBytes> changed = ticks;
                TickBytes& tick = changed[index - 1];
                (traffic ? tick.traffic : tick.tick)[at] ^= 1;
                if (replay::fault_of_tick(tick.tick, index) ||
                    replay::fault_of_traffic(tick.traffic, index))
                    continue;  // no reader would give it
                ++changes;
                write(recording_, changed, outcome);
                EXPECT_NE(verified(forged_), "") << index << " " << at;
                EXPECT_NE(compared(whole_, forged_), "") << index << " " << at;
            }
        }
    }
    EXPECT_GT(changes, 40);
}

TEST_F(ForgedTrace, IsToldWhenItEndsOtherwise) {
    std::vector<TickBytes> ticks = recorded_ticks();
    const world::Outcome outcome = TraceReader(whole_).outcome();
    ASSERT_EQ(outcome.verdict, "failed");
    write(recording_, ticks, {"passed", outcome.reason, 6});
    EXPECT_EQ(verified(forged_),
              "tick 6 (0.30 s), stage end\n"
              "  field     outcome\n"
              "  expected  passed: time limit\n"
              "  found     failed: time limit\n"
              "  note      all ticks are equal\n");
    EXPECT_THAT(compared(whole_, forged_), HasSubstr("outcome.verdict"));
    write(recording_, ticks, {"failed", "arrived", 6});
    EXPECT_THAT(verified(forged_), HasSubstr("failed: arrived"));
    write(recording_, ticks, world::outcome_of_cut_off(6));
    EXPECT_THAT(verified(forged_), HasSubstr("error: the trace was cut off"));
    ticks.pop_back();
    write(recording_, ticks, {"failed", "time limit", 5});
    EXPECT_THAT(verified(forged_), HasSubstr("the run goes on"));
    write(recording_, ticks, world::outcome_of_cut_off(5));
    EXPECT_EQ(verified(forged_), "");  // and it says that it was cut off
    write(recording_, ticks, world::outcome_of_part(5));
    EXPECT_THAT(verified(forged_), HasSubstr("is a part, and nothing else is"));
}

TEST_F(ForgedTrace, IsToldOfABranchBehindItsEnd) {
    world::Recording changed = recording_;
    changed.episode.branches.push_back({});
    changed.episode.branches.back().tick = 6;
    changed.episode.branches.back().max_ticks = 100;
    write(changed, recorded_ticks(), TraceReader(whole_).outcome());
    EXPECT_THAT(verified(forged_), HasSubstr("a branch at tick 6"));
}

}  // namespace
}  // namespace reprise::test
