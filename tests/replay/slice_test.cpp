#include "replay/slice.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "replay/compare/divergence.h"
#include "replay/level.h"
#include "replay/recovery.h"
#include "replay/trace_writer.h"
#include "tests/replay/sliced_run.h"

namespace reprise::replay {
namespace {

using testing::HasSubstr;

class Slice : public test::SlicedRun {};

TEST_F(Slice, HoldsTheTicksOfTheTraceByteForByte) {
    TraceReader trace(whole_);
    for (const auto& [first, last] : {std::pair{1, 1}, {1, 149}, {63, 66}, {65, 128}, {100, 150}}) {
        const auto from = static_cast<std::uint64_t>(first);
        const auto to = static_cast<std::uint64_t>(last);
        TraceReader part(cut(from, to));
        EXPECT_EQ(part.first(), from);
        EXPECT_EQ(part.last(), to);
        EXPECT_EQ(part.ticks(), to - from + 1);
        EXPECT_EQ(part.run_ticks(), 150U);
        EXPECT_TRUE(part.chain(from - 1) == trace.chain(from - 1));
        EXPECT_EQ(part.damage(), std::nullopt);
        for (std::uint64_t index = from; index <= to; ++index) {
            const test::TickBytes expected = test::bytes_of(trace.tick(index));
            EXPECT_TRUE(test::bytes_of(part.tick(index)) == expected) << index;
        }
    }
}

TEST_F(Slice, OfAllTicksIsTheTraceAgain) {
    EXPECT_TRUE(test::read_file(cut(1, 150)) == test::read_file(whole_));
}

TEST_F(Slice, MergedWithTheRestIsTheTraceAgain) {
    for (const std::uint64_t at : {1, 63, 64, 65, 149}) {
        const auto head = cut(1, at);
        EXPECT_TRUE(test::read_file(join(head, cut(at + 1, 150))) == test::read_file(whole_)) << at;
    }
}

TEST_F(Slice, OfASliceIsTheSliceOfTheWhole) {
    TraceReader part(cut(10, 140));
    slice(part, 70, 80, folder_ / "inner.mcap");
    EXPECT_TRUE(test::read_file(folder_ / "inner.mcap") == test::read_file(cut(70, 80)));
}

TEST_F(Slice, ManyAreMergedInWhateverOrderTheyAreGiven) {
    const std::vector parts{cut(65, 100), cut(1, 1), cut(101, 150), cut(2, 64)};
    EXPECT_TRUE(test::read_file(join(parts)) == test::read_file(whole_));
    EXPECT_THAT(test::error_of([&] {
                    join({folder_ / "101.mcap", folder_ / "1.mcap", folder_ / "65.mcap"});
                }),
                HasSubstr("ticks 2 to 64 are missing between them"));
}

TEST_F(Slice, MergedInTheMiddleIsASlice) {
    const auto merged = test::read_file(join(cut(20, 70), cut(71, 99)));
    EXPECT_TRUE(merged == test::read_file(cut(20, 99)));
}

TEST_F(Slice, MergeRefusesWhatDoesNotFit) {
    EXPECT_THAT(refusal(cut(1, 50), cut(52, 60)), HasSubstr("tick 51 is missing between them"));
    EXPECT_THAT(refusal(cut(70, 80), cut(1, 50)), HasSubstr("ticks 51 to 69 are missing"));
    EXPECT_THAT(refusal(cut(40, 60), cut(1, 40)), HasSubstr("tick 40 is in both"));
    EXPECT_THAT(refusal(cut(1, 60), cut(20, 30)), HasSubstr("ticks 20 to 30 are in both"));
    EXPECT_THAT(refusal(cut(20, 30), cut(20, 30)), HasSubstr("ticks 20 to 30 are in both"));
    const auto other = folder_ / "other.mcap";
    test::write_trace(other, {.ticks = 150, .seed = 8});
    {
        TraceReader trace(other);
        slice(trace, 61, 150, folder_ / "other_end.mcap");
    }
    EXPECT_THAT(refusal(cut(40, 60), folder_ / "other_end.mcap"), HasSubstr("different runs"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.mcap"));
}

/// The same start, but something went otherwise before the seam.
TEST_F(Slice, MergeRefusesAnotherHistory) {
    const auto other = folder_ / "other.mcap";
    test::write_trace(other, {.ticks = 150, .change = [](world::TickDraft& draft) {
                                  if (draft.tick.index == 30)
                                      draft.tick.digests.mutate_physics(1);
                              }});
    {
        TraceReader trace(other);
        slice(trace, 61, 150, folder_ / "other_end.mcap");
    }
    EXPECT_THAT(refusal(cut(1, 60), folder_ / "other_end.mcap"), HasSubstr("another history"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.mcap"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.mcap.partial"));
}

/// A trace with a tick in the middle that goes on with nothing: every checksum is right, and the
/// seams fit.
class BrokenChain : public Slice {
  protected:
    /// Ticks `first` to `last` of the run, tick 30 with another link.
    std::filesystem::path write(std::uint64_t first, std::uint64_t last) {
        const auto path = folder_ / ("broken" + std::to_string(first) + ".mcap");
        TraceReader trace(whole_);
        TraceWriter writer(path,
                           trace.recording(),
                           Level::full,
                           Unfinished::remove,
                           world::SliceStart{first, 150, trace.chain(first - 1)});
        for (std::uint64_t index = first; index <= last; ++index) {
            const RecordedTick tick = trace.recorded(index);
            test::TickBytes bytes = test::bytes_of(tick);
            if (index == 30) {
                const world::Digest128 link = tick.view.tick->digests()->chain();
                const auto* text = reinterpret_cast<const std::uint8_t*>(&link);
                *std::search(bytes.tick.begin(), bytes.tick.end(), text, text + sizeof(link)) ^= 1;
            }
            writer.append({{world::GetTick(bytes.tick.data()), tick.view.traffic},
                           bytes.tick,
                           tick.traffic_bytes});
        }
        writer.close(trace.outcome());
        return path;
    }
};

TEST_F(BrokenChain, IsNotCut) {
    TraceReader trace(write(1, 60));
    EXPECT_THAT(test::error_of([&] { slice(trace, 20, 40, folder_ / "cut.mcap"); }),
                HasSubstr("tick 30 does not continue the digest chain"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.mcap"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.mcap.partial"));
}

TEST_F(BrokenChain, IsNotJoined) {
    EXPECT_THAT(refusal(write(1, 60), cut(61, 150)),
                HasSubstr("tick 30 does not continue the digest chain"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.mcap"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.mcap.partial"));
}

TEST_F(Slice, WithoutTheRunsEndDoesNotSayHowItEnded) {
    EXPECT_EQ(TraceReader(cut(1, 149)).outcome().verdict, "part");
    EXPECT_EQ(TraceReader(cut(2, 150)).outcome().verdict, "passed");
    EXPECT_EQ(TraceReader(cut(3, 9)).outcome().verdict, "part");
}

TEST_F(Slice, HoldsNoTickThatItsRunDidNotHave) {
    const auto path = folder_ / "long.mcap";
    TraceReader trace(whole_);
    {
        TraceWriter writer(path,
                           trace.recording(),
                           Level::full,
                           Unfinished::remove,
                           world::SliceStart{100, 120, trace.chain(99)});
        for (std::uint64_t index = 100; index <= 121; ++index)
            writer.append(trace.recorded(index));
        writer.close(trace.outcome());
    }
    const std::string told = "a slice that holds tick 121 of a run of 120 ticks";
    EXPECT_THAT(test::error_of([&] { TraceReader{path}; }), HasSubstr(told));
    EXPECT_THAT(test::error_of([&] { TraceReader::salvage(path); }), HasSubstr(told));
}

TEST_F(Slice, OnlyTheStartOfARunCanBeSimulated) {
    const TraceReader head(cut(1, 50));
    EXPECT_EQ(test::error_of([&] { require_start_of_run(head); }), "");
    const TraceReader middle(cut(51, 60));
    EXPECT_THAT(test::error_of([&] { require_start_of_run(middle); }),
                HasSubstr("begins at tick 51"));
}

/// A trace of level `level`, and what is left of it between these ticks.
class SliceOfLevel : public Slice, public testing::WithParamInterface<Level> {
  protected:
    SliceOfLevel() {
        TraceReader full(whole_);
        TraceWriter writer(stripped_, full.recording(), GetParam());
        for (std::uint64_t index = 1; index <= full.ticks(); ++index)
            writer.append(full.recorded(index));
        writer.close(full.outcome());
    }

    std::filesystem::path cut_stripped(std::uint64_t first, std::uint64_t last) {
        const auto path = folder_ / (std::to_string(first) + ".stripped.mcap");
        TraceReader trace(stripped_);
        slice(trace, first, last, path);
        return path;
    }

    std::filesystem::path stripped_ = folder_ / "stripped.mcap";
};

INSTANTIATE_TEST_SUITE_P(EveryLevel,
                         SliceOfLevel,
                         testing::Values(Level::inputs, Level::core, Level::keyed, Level::full),
                         [](const auto& level) { return std::string(to_word(level.param)); });

TEST_P(SliceOfLevel, KeepsIt) {
    TraceReader trace(stripped_);
    TraceReader part(cut_stripped(1, 77));
    EXPECT_EQ(part.level(), GetParam());
    std::uint64_t bytes = 0;
    for (std::uint64_t index = 1; index <= 77; ++index) {
        const test::TickBytes expected = test::bytes_of(trace.recorded(index));
        EXPECT_TRUE(test::bytes_of(part.recorded(index)) == expected) << index;
        bytes += expected.tick.size() + expected.traffic.size();
    }
    EXPECT_EQ(part.message_bytes(), bytes);
    EXPECT_TRUE(test::read_file(cut_stripped(1, 150)) == test::read_file(stripped_));
}

TEST_P(SliceOfLevel, BeginsLaterOnlyWhereThereAreStates) {
    if (GetParam() == Level::inputs) {
        EXPECT_THAT(test::error_of([&] { cut_stripped(78, 150); }),
                    HasSubstr("only a slice from tick 1 on can be simulated again"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "78.stripped.mcap.partial"));
        return;
    }
    const auto rest = cut_stripped(78, 150);
    std::uint64_t bytes = 0;
    TraceReader part(rest);
    for (std::uint64_t index = 78; index <= 150; ++index) {
        const test::TickBytes kept = test::bytes_of(part.recorded(index));
        bytes += kept.tick.size() + kept.traffic.size();
    }
    EXPECT_EQ(part.message_bytes(), bytes);
    EXPECT_TRUE(test::read_file(join(cut_stripped(1, 77), rest)) == test::read_file(stripped_));
}

TEST_P(SliceOfLevel, IsRecoveredAsItWasWhenItIsTheStart) {
    const auto head = cut_stripped(1, 77);
    auto bytes = test::read_file(head);
    bytes.resize(bytes.size() - 40);
    test::write_file(folder_ / "cut.mcap", bytes);
    EXPECT_EQ(recover(folder_ / "cut.mcap", folder_ / "again.mcap").loss, "");
    EXPECT_TRUE(test::read_file(folder_ / "again.mcap") == test::read_file(head));
}

TEST_F(Slice, MergeRefusesOtherLevels) {
    TraceReader full(cut(1, 60));
    const auto core = folder_ / "core.mcap";
    {
        TraceWriter writer(core, full.recording(), Level::core, Unfinished::remove, full.slice());
        for (std::uint64_t index = 1; index <= 60; ++index)
            writer.append(full.recorded(index));
        writer.close(full.outcome());
    }
    EXPECT_THAT(refusal(core, cut(61, 150)), HasSubstr("of the levels core and full"));
}

TEST_F(Slice, ThatBeginsLaterIsNeitherComparedNorRecovered) {
    const auto middle = cut(51, 60);
    EXPECT_THAT(test::error_of([&] { recover(middle, folder_ / "again.mcap"); }),
                HasSubstr("cut it again from the whole trace"));
    TraceReader whole(whole_);
    TraceReader part(middle);
    Tolerance tolerance{1e-3};
    for (const auto& [expected, found] : {std::pair(&whole, &part), {&part, &whole}}) {
        EXPECT_THAT(test::error_of([&, e = expected, f = found] { compare(*e, *f); }),
                    HasSubstr("begins at tick 51"));
        EXPECT_THAT(test::error_of([&, e = expected, f = found] { compare(*e, *f, tolerance); }),
                    HasSubstr("begins at tick 51"));
    }
}

/// Equal as far as it goes: it ends earlier.
TEST_F(Slice, FromTheStartIsComparedTickByTick) {
    TraceReader whole(whole_);
    TraceReader head(cut(1, 60));
    const auto divergence = compare(whole, head);
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->stage, "end");
    EXPECT_EQ(divergence->tick, 61U);
}

}  // namespace
}  // namespace reprise::replay
