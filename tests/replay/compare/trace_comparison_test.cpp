// Of whole traces: their ticks, beginnings and ends.
#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "replay/compare/divergence.h"
#include "replay/trace_writer.h"
#include "tests/replay/synthetic_run.h"

namespace reprise::test {

namespace {

using replay::compare;
using replay::Divergence;
using replay::TraceReader;
using testing::HasSubstr;

class Traces : public testing::Test {
  protected:
    std::optional<Divergence> compared(const SyntheticRun& expected, const SyntheticRun& found) {
        write_trace(folder_ / "expected.mcap", expected);
        write_trace(folder_ / "found.mcap", found);
        return compared();
    }

    std::optional<Divergence> compared() {
        TraceReader expected(folder_ / "expected.mcap");
        TraceReader found(folder_ / "found.mcap");
        return compare(expected, found);
    }

    Folder folder_;
};

TEST_F(Traces, AreEqualWhenTheirRunsAre) {
    EXPECT_EQ(compared({}, {}), std::nullopt);
    EXPECT_EQ(compared({.ticks = 0}, {.ticks = 0}), std::nullopt);
}

TEST_F(Traces, DifferAtTheVeryTickThatWasNudgedWhereverThatIs) {
    std::mt19937_64 random(6);
    write_trace(folder_ / "expected.mcap", {.ticks = 200});
    for (const std::uint64_t tick : {1ul, 64ul, 65ul, 200ul, 1 + random() % 200}) {
        const auto nudge = [&](world::TickDraft& draft) {
            if (draft.tick.index >= tick)
                draft.tick.vehicles[0].mutate_steering_angle(1e-17);
        };
        write_trace(folder_ / "found.mcap", {.ticks = 200, .change = nudge});
        const auto divergence = compared();
        ASSERT_TRUE(divergence);
        EXPECT_EQ(divergence->tick, tick);
        EXPECT_EQ(divergence->field, "vehicles[id 1].steering_angle");
        EXPECT_EQ(divergence->actor, "ego (1)");
    }
}

/// As a kernel does: what differs, differs in its stage's digest, and for ever.
Change parted(std::uint64_t tick) {
    return [=](world::TickDraft& draft) {
        if (draft.tick.index < tick)
            return;
        draft.tick.vehicles[0].mutate_odometer(1e9);
        draft.tick.digests.mutate_physics(draft.tick.digests.physics() + 1);
    };
}

TEST_F(Traces, AreSearchedAlongTheirChains) {
    constexpr std::uint64_t ticks = 64 * 9 + 5;
    write_trace(folder_ / "expected.mcap", {.ticks = ticks});
    for (const std::uint64_t tick : {1ul, 2ul, 64ul, 65ul, 333ul, ticks - 1, ticks}) {
        write_trace(folder_ / "found.mcap", {.ticks = ticks, .change = parted(tick)});
        const auto divergence = compared();
        ASSERT_TRUE(divergence);
        EXPECT_EQ(divergence->tick, tick);
        EXPECT_EQ(divergence->field, "vehicles[id 1].odometer");
        EXPECT_EQ(divergence->actor, "ego (1)");
    }
    // Of different lengths, and beyond the shorter one's end.
    write_trace(folder_ / "found.mcap", {.ticks = 200, .change = parted(150)});
    EXPECT_EQ(compared()->tick, 150u);
    write_trace(folder_ / "found.mcap", {.ticks = 200, .change = parted(201)});
    EXPECT_EQ(compared()->stage, "end");
}

TEST_F(Traces, AreSearchedThoughAChunkOnTheWayIsDamaged) {
    write_trace(folder_ / "expected.mcap", {.ticks = 300});
    write_trace(folder_ / "found.mcap", {.ticks = 300, .change = parted(40)});
    auto bytes = read_file(folder_ / "found.mcap");
    bytes[bytes.size() / 2] ^= 1;
    write_file(folder_ / "found.mcap", bytes);
    EXPECT_EQ(compared()->tick, 40u);
}

TEST_F(Traces, AreEqualWithinAToleranceThatCoversAllTheirReals) {
    const auto moved = [](double by) {
        return [=](world::TickDraft& draft) {
            auto& odometer = draft.tick.vehicles[0];
            odometer.mutate_odometer(1000 * (1 + by));
            draft.traffic.cars[1].mutate_yaw(-3.14159f);  // else +3.14159: nearly the same
            draft.tick.digests.mutate_physics(1);
        };
    };
    write_trace(folder_ / "expected.mcap", {.change = moved(0)});
    write_trace(folder_ / "found.mcap", {.change = [&](world::TickDraft& draft) {
                    moved(1e-9)(draft);
                    draft.traffic.cars[1].mutate_yaw(3.14159f);
                    draft.tick.digests.mutate_physics(2);
                }});
    const auto within = [&](double bound, replay::Tolerance& tolerance) {
        TraceReader expected(folder_ / "expected.mcap");
        TraceReader found(folder_ / "found.mcap");
        tolerance.bound = bound;
        return replay::compare(expected, found, tolerance);
    };
    replay::Tolerance wide;
    EXPECT_EQ(within(1e-5, wide), std::nullopt);
    EXPECT_GT(wide.largest, 1e-6);  // of the yaw, the short way round
    EXPECT_EQ(wide.field, "cars[id 1000001].yaw");
    replay::Tolerance narrow;
    EXPECT_EQ(within(1e-7, narrow)->field, "cars[id 1000001].yaw");
    replay::Tolerance none;
    EXPECT_EQ(within(0, none)->tick, 1u);
}

TEST_F(Traces, AreNeverEqualWithinAToleranceWhenAnEventOrAnIdDiffers) {
    const auto first_with = [&](const Change& change) {
        write_trace(folder_ / "expected.mcap");
        write_trace(folder_ / "found.mcap", {.change = change});
        TraceReader expected(folder_ / "expected.mcap");
        TraceReader found(folder_ / "found.mcap");
        replay::Tolerance tolerance{1e6};
        return replay::compare(expected, found, tolerance).value_or(Divergence{});
    };
    EXPECT_EQ(first_with(at(80, [](auto& draft) { draft.tick.events.clear(); })).tick, 80u);
    EXPECT_EQ(first_with(at(40, [](auto& d) { d.tick.events[0].text = "x"; })).field,
              "events[0].text");
    EXPECT_EQ(first_with(at(7, [](auto& d) { d.traffic.cars.pop_back(); })).found, "absent");
    EXPECT_EQ(first_with(at(7, [](auto& d) { d.traffic.cars[0].mutate_lane(5); })).field,
              "cars[id 1000000].lane");
    EXPECT_EQ(
        first_with(at(7, [](auto& d) { d.tick.vehicles[0].mutate_odometer(std::nan("")); })).field,
        "vehicles[id 1].odometer");
}

TEST_F(Traces, DifferWhereABytesDoesThoughAllDigestsAgree) {
    const auto divergence = compared(
        {},
        {.change = at(77, [](world::TickDraft& d) { d.tick.weather.mutate_fog_extinction(1); })});
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->tick, 77u);
    EXPECT_EQ(divergence->field, "weather.fog_extinction");
}

/// From `hidden` on only the digest of traffic differs, from `shown` on a recorded field too.
Change diverging(std::uint64_t hidden, std::uint64_t shown) {
    return [=](world::TickDraft& draft) {
        if (draft.tick.index >= hidden)
            draft.tick.digests.mutate_traffic(draft.tick.digests.traffic() + 1);
        if (draft.tick.index >= shown)
            draft.traffic.cars[2].mutate_lane_s(1);
    };
}

TEST_F(Traces, FollowWhatOnlyADigestShowsUntilTheRecordDoes) {
    const auto divergence = compared({}, {.change = diverging(60, 130)});
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->tick, 60u);
    EXPECT_EQ(divergence->field, "digests.traffic");
    EXPECT_THAT(divergence->note,
                HasSubstr("it first shows at tick 130, stage traffic: cars[id 1000002].lane_s"));
    EXPECT_THAT(compared({}, {.change = diverging(60, 1000)})->note,
                HasSubstr("nothing in the record shows it in the next 90 ticks"));
}

/// The scenario sets a speed at tick 70 in line 31, and prints in line 35 at tick 80.
void say(world::TickDraft& draft) {
    if (draft.tick.index == 70) {
        world::CommandT command;
        command.kind = world::CommandKind::set_speed;
        command.actor = 1;
        command.line = 31;
        draft.tick.commands.push_back(command);
    }
    if (draft.tick.index == 80) {
        world::EventT event;
        event.kind = world::EventKind::printed;
        event.line = 35;
        draft.tick.events.push_back(event);
    }
}

TEST_F(Traces, NameWhatTheScenarioSaidLastBeforeTheirDifference) {
    const auto script_before = [&](std::uint64_t tick) {
        const auto found = compared({.change = say}, {.change = [&](world::TickDraft& draft) {
                                        say(draft);
                                        if (draft.tick.index == tick)
                                            draft.tick.vehicles[0].mutate_odometer(1e9);
                                    }});
        return found.value().script;
    };
    EXPECT_EQ(script_before(69), "");
    EXPECT_THAT(script_before(70), testing::EndsWith(":31"));
    EXPECT_THAT(script_before(79), HasSubstr("tick 70 (3.50 s): set_speed of ego (1), "));
    EXPECT_THAT(script_before(90), HasSubstr("tick 80 (4.00 s): printed, "));
}

TEST_F(Traces, DoNotTakeAChangedCommandForWhatWasBeforeIt) {
    const auto found = compared({.change = say}, {.change = [](world::TickDraft& draft) {
                                    say(draft);
                                    for (world::CommandT& command : draft.tick.commands)
                                        command.speed = 5;
                                }});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->field, "commands[0].speed");
    EXPECT_EQ(found->script, "");
}

TEST_F(Traces, OfOtherSeedsDifferWhereTheirTicksDoNotWhereTheirChainsDo) {
    const auto divergence = compared(
        {.seed = 7},
        {.seed = 8, .change = at(90, [](auto& draft) { draft.traffic.cars[0].mutate_speed(1); })});
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->tick, 90u);
    EXPECT_EQ(divergence->stage, "traffic");
    EXPECT_EQ(divergence->field, "cars[id 1000000].speed");
    EXPECT_THAT(divergence->note, HasSubstr("did not start from the same: seed 7 / 8"));
}

TEST_F(Traces, OfOtherSeedsAndEqualTicksDifferInTheirStart) {
    const auto divergence = compared({.seed = 7}, {.seed = 8});
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->tick, 0u);
    EXPECT_EQ(divergence->stage, "start");
    EXPECT_EQ(divergence->field, "seed");
    EXPECT_THAT(divergence->note, HasSubstr("all 150 ticks are equal nevertheless"));
}

TEST_F(Traces, DifferInTheirEndWhenOneGoesOn) {
    const auto divergence = compared({.ticks = 100}, {.ticks = 101});
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->tick, 101u);
    EXPECT_EQ(divergence->stage, "end");
    EXPECT_THAT(divergence->expected, HasSubstr("100 (passed"));
    EXPECT_THAT(divergence->found, HasSubstr("101 (passed"));
}

TEST_F(Traces, OfOtherBuildsAreEqualWhenTheirRunsAre) {
    const auto write = [&](const std::string& name, const std::string& compiler, double speed) {
        world::Recording start = recording();
        start.episode.fingerprint.emplace_back();
        start.episode.fingerprint.back().key = "compiler";
        start.episode.fingerprint.back().value = compiler;
        replay::TraceWriter writer(folder_ / name, start);
        const auto change = [=](world::TickDraft& d) {
            d.tick.measurements[0].mutate_speed(speed);
        };
        writer.append(drive({.ticks = 1, .change = change}).front());
        writer.close({"completed", "", 1});
    };
    write("expected.mcap", "GNU 12.2.0", 1);
    write("found.mcap", "GNU 13.1.0", 1);
    EXPECT_EQ(compared(), std::nullopt);
    write("found.mcap", "GNU 13.1.0", 2);
    EXPECT_EQ(compared()->field, "measurements[actor 1].speed");
}

TEST_F(Traces, AreNotCalledEqualWhenOneIsDamaged) {
    write_trace(folder_ / "expected.mcap");
    auto bytes = read_file(folder_ / "expected.mcap");
    bytes[bytes.size() / 2] ^= 1;
    write_file(folder_ / "expected.mcap", bytes);
    write_file(folder_ / "found.mcap", bytes);
    EXPECT_NE(error_of([&] { compared(); }), "");
}

}  // namespace

}  // namespace reprise::test
