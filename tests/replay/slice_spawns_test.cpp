#include <gmock/gmock.h>

#include "replay/slice.h"
#include "replay/table/actor_search.h"
#include "replay/trace_facts.h"
#include "replay/trace_writer.h"
#include "tests/replay/sliced_run.h"

namespace reprise::replay {
namespace {

using testing::HasSubstr;

world::CommandT spawn_of(std::uint32_t actor, const std::string& name) {
    world::CommandT command;
    command.kind = world::CommandKind::spawn;
    command.actor = actor;
    command.text = name;
    command.line = 3;
    return command;
}

/// A run in which actors come at ticks 1, 5 and 40, of whom the second goes at tick 30.
class SliceBehindSpawns : public test::SlicedRun {
  protected:
    SliceBehindSpawns() {
        test::write_trace(whole_, {.ticks = 150, .change = [](world::TickDraft& draft) {
                                       auto& commands = draft.tick.commands;
                                       if (draft.tick.index == 1)
                                           commands.push_back(spawn_of(1, "ego"));
                                       if (draft.tick.index == 5)
                                           commands.push_back(spawn_of(2, "lead"));
                                       if (draft.tick.index == 40)
                                           commands.push_back(spawn_of(11, "late"));
                                       if (draft.tick.index == 30) {
                                           commands.push_back(spawn_of(2, ""));
                                           commands.back().kind = world::CommandKind::despawn;
                                       }
                                   }});
    }

    /// "TICK NAME" of each.
    static std::vector<std::string> told(const TraceReader& trace) {
        std::vector<std::string> all;
        const auto slice = trace.slice();
        for (const auto& [actor, spawn] : slice ? slice->spawns : world::Spawns()) {
            EXPECT_EQ(spawn.command.actor, actor);
            all.push_back(std::to_string(spawn.tick) + " " + spawn.command.text);
        }
        return all;
    }

    /// The run's ticks from `first` to `last`, told to be of these actors.
    std::filesystem::path claim(std::uint64_t first, std::uint64_t last, world::Spawns spawns) {
        const auto path = folder_ / ("claimed" + std::to_string(first) + ".mcap");
        TraceReader trace(whole_);
        TraceWriter writer(
            path,
            trace.recording(),
            Level::full,
            Unfinished::remove,
            world::SliceStart{first, 150, trace.chain(first - 1), std::move(spawns)});
        for (std::uint64_t index = first; index <= last; ++index)
            writer.append(trace.recorded(index));
        writer.close(trace.outcome());
        return path;
    }
};

TEST_F(SliceBehindSpawns, KnowsWhoWasThere) {
    using testing::ElementsAre;
    EXPECT_THAT(told(TraceReader(cut(1, 50))), ElementsAre()) << "its ticks say it";
    EXPECT_THAT(told(TraceReader(cut(2, 50))), ElementsAre("1 ego"));
    EXPECT_THAT(told(TraceReader(cut(6, 50))), ElementsAre("1 ego", "5 lead"));
    EXPECT_THAT(told(TraceReader(cut(30, 50))), ElementsAre("1 ego", "5 lead"));
    EXPECT_THAT(told(TraceReader(cut(31, 50))), ElementsAre("1 ego"));
    EXPECT_THAT(told(TraceReader(cut(41, 150))), ElementsAre("1 ego", "40 late"));
    EXPECT_EQ(TraceReader(folder_ / "41.mcap").damage(), std::nullopt);
    EXPECT_EQ(TraceReader(folder_ / "41.mcap").slice()->spawns[11].command, spawn_of(11, "late"));
}

TEST_F(SliceBehindSpawns, IsCutAgainAndJoinedWithoutADifference) {
    TraceReader part(cut(10, 140));
    slice(part, 70, 80, folder_ / "inner.mcap");
    EXPECT_TRUE(test::read_file(folder_ / "inner.mcap") == test::read_file(cut(70, 80)));
    const auto merged = test::read_file(join(cut(20, 35), cut(36, 99)));
    EXPECT_TRUE(merged == test::read_file(cut(20, 99)));
    EXPECT_TRUE(test::read_file(join({cut(1, 29), cut(30, 41), cut(42, 150)})) ==
                test::read_file(whole_));
}

TEST_F(SliceBehindSpawns, FindsThemByTheirNames) {
    TraceReader part(cut(50, 60));
    EXPECT_EQ(find_actor(part, "late"), 11U);
    EXPECT_THAT(test::error_of([&] { find_actor(part, "lead"); }), HasSubstr("no actor 'lead'"));
}

TEST_F(SliceBehindSpawns, MergeRefusesOneThatSaysOtherwiseWhoIsThere) {
    for (const world::Spawns& forged :
         {world::Spawns{}, world::Spawns{{1, {spawn_of(1, "other"), 1}}}})
        EXPECT_THAT(refusal(cut(1, 40), claim(41, 150, forged)),
                    HasSubstr("the second says otherwise who is there"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.mcap"));
}

TEST_F(SliceBehindSpawns, RefusesWhatIsNoSpawnBeforeIt) {
    world::CommandT despawn = spawn_of(1, "ego");
    despawn.kind = world::CommandKind::despawn;
    for (const world::Spawn& forged : {world::Spawn{spawn_of(1, "ego"), 41},
                                       world::Spawn{spawn_of(1, "ego"), 0},
                                       world::Spawn{spawn_of(2, "ego"), 1},
                                       world::Spawn{despawn, 1}})
        EXPECT_THAT(test::error_of([&] {
                        TraceReader{claim(41, 50, {{1, forged}})};
                    }),
                    HasSubstr("its 'slice.spawn.1' is no spawn before tick 41"));
}

/// Digits that are none, bytes that are no command, and a command written in another way.
TEST(SpawnsOfASlice, AreReadFromForeignBytes) {
    Facts facts;
    add_spawns({{1, {spawn_of(1, "ego"), 7}}}, facts);
    const std::string written = facts.at("slice.spawn.1");
    world::Spawns spawns;
    EXPECT_EQ(take_spawns(facts, 8, spawns), std::nullopt);
    EXPECT_EQ(spawns.at(1).command, spawn_of(1, "ego"));
    for (const std::string& forged : {std::string(),
                                      std::string("7"),
                                      "7  " + written.substr(2),
                                      "-" + written,
                                      "8" + written.substr(1),
                                      written + "0",
                                      written + "0g",
                                      std::string("7 "),
                                      std::string("7 00000000"),
                                      "7 ffffff7f" + written.substr(10)}) {
        facts["slice.spawn.1"] = forged;
        EXPECT_NE(take_spawns(facts, 8, spawns), std::nullopt) << forged;
    }
    // Cut anywhere it is refused, or a shorter command: never more is read than is there.
    for (std::size_t length = 0; length < written.size(); ++length) {
        facts["slice.spawn.1"] = written.substr(0, length);
        take_spawns(facts, 8, spawns);
    }
    EXPECT_NE(take_spawns({{"slice.spawn.", written}}, 8, spawns), std::nullopt);
    EXPECT_NE(take_spawns({{"slice.spawn.4294967297", written}}, 8, spawns), std::nullopt);
}

}  // namespace
}  // namespace reprise::replay
