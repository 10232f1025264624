#include "replay/level.h"

#include <gmock/gmock.h>

#include "replay/compare/divergence.h"
#include "replay/recovery.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/replay/synthetic_run.h"

namespace reprise::test {
namespace {

using replay::Level;
using testing::HasSubstr;

constexpr Level all_levels[] = {Level::inputs, Level::core, Level::keyed, Level::full};

/// A run whose vehicle 1 is driven by hand, and a second one that is not.
SyntheticRun driven_by_hand() {
    SyntheticRun run;
    run.change = [](world::TickDraft& draft) {
        draft.tick.controls.emplace_back(0.5, 0.0, 0.0, 2u, std::uint16_t{0}, false, false);
        if (draft.tick.index > 1)
            return;
        for (const std::uint32_t actor : {1u, 2u}) {
            world::CommandT& spawn = draft.tick.commands.emplace_back();
            spawn.kind = world::CommandKind::spawn;
            spawn.actor = actor;
            spawn.driver = actor == 1 ? world::Driver::manual : world::Driver::autopilot;
        }
    };
    return run;
}

class Levels : public testing::Test {
  protected:
    std::filesystem::path path(Level level, const std::string& name = "run") const {
        return folder_ / (name + "." + replay::to_word(level) + ".mcap");
    }

    void write(Level level, const SyntheticRun& run, const std::string& name = "run") const {
        const world::Recording start = recording(run.seed);
        replay::TraceWriter writer(path(level, name), start, level);
        for (const world::SealedTick& tick : drive(run))
            writer.append(tick);
        writer.close({"passed", "finished at line 2: arrived", run.ticks});
    }

    const Folder folder_;
    const SyntheticRun run_ = driven_by_hand();
};

TEST_F(Levels, KeepEveryDigestAndTheControlsOfThoseDrivenByHand) {
    const auto ticks = drive(run_);
    for (const Level level : all_levels) {
        write(level, run_);
        replay::TraceReader trace(path(level));
        ASSERT_EQ(trace.level(), level);
        ASSERT_EQ(trace.ticks(), ticks.size());
        ASSERT_FALSE(trace.damage());
        for (const world::SealedTick& tick : ticks) {
            const replay::RecordedTick kept = trace.recorded(tick.view().index());
            ASSERT_EQ(*kept.view.tick->digests(), *tick.view().tick->digests());
            ASSERT_NE(world::find(kept.view.controls(), 1), nullptr);
            ASSERT_EQ(*world::find(kept.view.controls(), 1), tick.view().controls()[0]);
            ASSERT_EQ(world::find(kept.view.controls(), 2) == nullptr, level == Level::inputs);
            ASSERT_EQ(
                kept.view.traffic != nullptr,
                level == Level::full || (level == Level::keyed && tick.view().index() % 20 == 1));
        }
    }
    for (int i = 1; i < 4; ++i)
        EXPECT_LT(std::filesystem::file_size(path(all_levels[i - 1])),
                  std::filesystem::file_size(path(all_levels[i])));
}

TEST_F(Levels, SayHowToGetWhatTheyLack) {
    for (const auto& [level, tick, text] :
         {std::tuple(Level::inputs, 1u, "holds inputs only; `reprise expand "),
          std::tuple(Level::core, 1u, "holds no traffic; `reprise expand "),
          std::tuple(Level::keyed, 2u, "holds traffic in ticks 1, 21, 41, ... only")}) {
        write(level, run_);
        replay::TraceReader trace(path(level));
        EXPECT_THAT(error_of([&] { trace.tick(tick); }), HasSubstr(text));
    }
    replay::TraceReader keyed(path(Level::keyed));
    for (const world::SealedTick& tick : drive(run_)) {
        const std::uint64_t index = tick.view().index();
        if (index % 20 == 1) {
            EXPECT_EQ(bytes_of(keyed.tick(index)), bytes_of(tick));
        }
    }
}

TEST_F(Levels, StrippingAStrippedTraceIsStrippingTheFullOne) {
    for (const Level level : all_levels)
        write(level, run_);
    for (const Level from : all_levels) {
        for (const Level to : all_levels) {
            if (to > from)
                continue;
            replay::TraceReader trace(path(from));
            replay::TraceWriter writer(path(to, "again"), trace.recording(), to);
            for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
                writer.append(trace.recorded(index));
            writer.close(trace.outcome());
            EXPECT_TRUE(read_file(path(to, "again")) == read_file(path(to)))
                << replay::to_word(from) << " to " << replay::to_word(to);
        }
    }
}

TEST_F(Levels, OfTwoRunsAreComparedInWhatBothHold) {
    for (const Level level : all_levels)
        write(level, run_);
    SyntheticRun other = run_;
    other.change = [&](world::TickDraft& draft) {
        run_.change(draft);
        if (draft.tick.index == 99) {
            draft.tick.vehicles[0].mutable_velocity().mutate_x(13);
            draft.tick.digests.mutate_physics(99);
        }
    };
    for (const Level level : all_levels)
        write(level, other, "other");
    for (const Level left : all_levels) {
        for (const Level right : all_levels) {
            replay::TraceReader expected(path(left));
            replay::TraceReader same(path(right));
            EXPECT_FALSE(replay::compare(expected, same));
            replay::TraceReader different(path(right, "other"));
            const auto divergence = replay::compare(expected, different);
            ASSERT_TRUE(divergence);
            EXPECT_EQ(divergence->tick, 99U);
            EXPECT_EQ(divergence->stage, "physics");
            EXPECT_EQ(divergence->field,
                      std::min(left, right) == Level::inputs ? "digests.physics"
                                                             : "vehicles[id 1].velocity.x");
        }
    }
}

TEST_F(Levels, OfATraceThatWasCutOffAreRecoveredAsTheyWere) {
    for (const Level level : all_levels) {
        write(level, run_);
        auto bytes = read_file(path(level));
        bytes.resize(bytes.size() - 40);
        write_file(folder_ / "cut.mcap", bytes);
        EXPECT_EQ(replay::recover(folder_ / "cut.mcap", folder_ / "whole.mcap").loss, "");
        EXPECT_TRUE(read_file(folder_ / "whole.mcap") == read_file(path(level)));
    }
}

TEST_F(Levels, UnfinishedTracesGoWhenTheyAreNotWorthKeeping) {
    for (const auto unfinished : {replay::Unfinished::keep, replay::Unfinished::remove}) {
        const auto partial = path(Level::full, "half").string() + ".partial";
        {
            replay::TraceWriter writer(
                path(Level::full, "half"), recording(), Level::full, unfinished);
            for (const world::SealedTick& tick : drive(run_))
                writer.append(tick);
        }
        EXPECT_EQ(std::filesystem::exists(partial), unfinished == replay::Unfinished::keep);
        std::filesystem::remove(partial);
    }
}

}  // namespace
}  // namespace reprise::test
