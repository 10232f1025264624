#include "scripting/words/handles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/models/catalogue.h"

namespace reprise::scripting {

using test::printed;
using testing::ElementsAre;
using testing::HasSubstr;
using world::CommandKind;

TEST(Spawn, SaysOneCommandWithEverythingResolved) {
    test::Stage stage(
        test::running("\nspawn{ name = 'ego', model = 'suv', driver = 'traffic', lane = 'east_2', "
                      "s = 20, speed_kmh = 36, lane_changes = false } wait(1)"));
    const world::TickDraft& draft = stage.step();
    ASSERT_EQ(draft.tick.commands.size(), 2U);
    EXPECT_EQ(draft.tick.commands[1].kind, CommandKind::change_lane);
    EXPECT_THAT(draft.tick.commands[1].lanes, ElementsAre(world::none)) << "to none";
    const world::CommandT& command = draft.tick.commands[0];
    EXPECT_EQ(command.kind, CommandKind::spawn);
    EXPECT_EQ(command.actor, 1U);
    EXPECT_EQ(command.driver, world::Driver::traffic);
    EXPECT_EQ(command.model, world::find_vehicle_model("suv"));
    EXPECT_EQ(command.lane, world::find_lane(stage.town, "east_2"));
    EXPECT_EQ(command.s, 20);
    EXPECT_DOUBLE_EQ(command.speed, 10);
    EXPECT_EQ(command.text, "ego");
    EXPECT_EQ(command.line, 2U);
}

TEST(Spawn, NumbersActorsAndNamesThemByTheirModel) {
    EXPECT_THAT(printed("local a, b = spawn{ model = 'sedan' }, spawn{ model = 'sedan' } "
                        "local c = spawn{ model = 'child', lane = 'east_0', s = 3 } "
                        "print(a:name(), b:name(), c, a:id(), b:id(), c:id(), a == b)"),
                ElementsAre("sedan sedan_2 child 1 2 3 false"));
}

TEST(Handle, IsUsableInTheLineAfterSpawn) {
    EXPECT_THAT(printed("local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20, speed = 10 } "
                        "print(ego:exists(), tick()) print(ego:speed(), tick())"),
                ElementsAre("false 0", "10.0 1"));
}

TEST(Handle, ReadsTheActorsState) {
    EXPECT_THAT(
        printed(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20, speed = 10 }
        local other = spawn{ model = 'sedan', driver = 'manual', lane = 'west_2', s = 100, offset = 0.5 }
        print(ego:lane(), ego:s(), ego:offset(), ego:x(), ego:y(), ego:speed_kmh())
        print(other:lane(), other:s(), string.format('%.3f %.3f', other:offset(), other:heading_deg()))
        wait_ticks(3)
        print(string.format('%.3f %.3f', ego:x(), other:distance_driven())))"),
        ElementsAre(
            "east_1 20.5 0.0 20.5 -5.25 36.0", "west_2 100.0 0.500 180.000", "22.000 0.000"));
}

TEST(Handle, AddsUpTheDistanceOfWhoHasNoOdometer) {
    EXPECT_THAT(
        printed(
            "local car = spawn{ model = 'sedan', driver = 'traffic', lane = 'east_1', speed = 10 } "
            "wait_ticks(11) print(string.format('%.3f', car:distance_driven()))"),
        ElementsAre("5.000"));
}

TEST(Handle, KnowsWhomItTouchedSinceItsSpawn) {
    test::Stage stage(test::running(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 50 }
        local child = spawn{ model = 'child', lane = 'east_0', s = 50 }
        local van = spawn{ model = 'van', driver = 'parked', lane = 'east_0', s = 90 }
        while true do
            print(ego:collided(), ego:collided(child), ego:collided(van), child:collided(ego),
                  ego:collided('walker'), ego:collided('vehicle'), ego:collided('static'))
            wait_ticks(1)
        end)"));
    stage.play(3);
    stage.collide(1, 2);
    stage.play(2);
    stage.collide(1, 0);
    stage.collide(1, 1'000'007);
    EXPECT_EQ(stage.play(2).back(), "true true false true true true true");
    EXPECT_EQ(stage.play(0).at(2), "false false false false false false false");
    EXPECT_EQ(stage.play(0).at(3), "true true false true true false false");
}

TEST(Handle, PlansAWayToAPlace) {
    test::Stage stage(test::running(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 50 }
        wait_ticks(1)
        print(ego:route_to{ lane = 'east_1', s = 90 })
        print(ego:route_to{ lane = 'east_2' }))"));
    const auto printed = stage.play(3);
    ASSERT_EQ(printed.size(), 2U);
    EXPECT_NEAR(std::stod(printed[0]), 40, 1e-6);
    EXPECT_NEAR(std::stod(printed[1]), 350, 1e-6);
    std::vector<std::vector<std::uint32_t>> routes;
    for (const auto& command : stage.commands)
        if (command.kind == CommandKind::set_route)
            routes.push_back(command.lanes);
    ASSERT_EQ(routes.size(), 2U);
    EXPECT_THAT(routes[0], ElementsAre(1));
    EXPECT_THAT(routes[1], ElementsAre(2)) << "by the time it obeys, it may be on another lane";
}

TEST(Handle, TellsAnotherProgramWhereToGo) {
    test::Stage stage(test::running(R"(
        local other = spawn{ model = 'sedan', driver = 'external', lane = 'east_1', s = 50 }
        wait_ticks(1)
        other:set_route{ 'east_1' }
        print(other:route_to{ lane = 'east_1', s = 90 }))"));
    EXPECT_NEAR(std::stod(stage.play(3).back()), 40, 1e-6);
    std::vector<double> ends;
    for (const auto& command : stage.commands)
        if (command.kind == CommandKind::set_route)
            ends.push_back(command.s);
    EXPECT_THAT(ends, ElementsAre(stage.town.lanes[1].length, 90));
}

TEST(Handle, GivesADriverInAnotherProgramAGoalAndNothingElse) {
    test::Stage stage(test::running(R"(
        local ego = spawn{ model = 'sedan', driver = 'external', lane = 'east_1', s = 50 }
        wait_ticks(1)
        print(ego:route_to{ lane = 'east_1', s = 90 })
        ego:set_route{ 'east_2', 'west' }
        print(select(2, pcall(ego.set_speed, ego, 3)))
        print(select(2, pcall(ego.change_lane, ego, 'left'))))"));
    const auto printed = stage.play(3);
    ASSERT_EQ(printed.size(), 3U);
    EXPECT_NEAR(std::stod(printed[0]), 40, 1e-6);
    EXPECT_THAT(printed[1], HasSubstr("set_speed: 'sedan' is driven by another program"));
    EXPECT_THAT(printed[2], HasSubstr("change_lane: 'sedan' is driven by another program"));
    std::vector<std::vector<std::uint32_t>> routes;
    for (const auto& command : stage.commands)
        if (command.kind == CommandKind::set_route)
            routes.push_back(command.lanes);
    EXPECT_THAT(routes, ElementsAre(ElementsAre(1), ElementsAre(2, 4)));
}

TEST(Handle, SaysWhatAnActorIsTold) {
    test::Stage stage(test::running(R"(
        local ego = spawn{ model = 'sedan', driver = 'traffic', lane = 'east_1', s = 50 }
        local child = spawn{ model = 'child', lane = 'east_0', s = 50 }
        local hand = spawn{ model = 'van', driver = 'manual', lane = 'west_1', s = 50 }
        wait_ticks(1)
        ego:set_speed_kmh(36, { over = 2 }) ego:free_speed() ego:change_lane('left', { over = 2.5 })
        ego:change_lane('east_1') ego:set_route{ 'east_2', 'west' }
        child:walk{ to = { 3, 4 }, speed_kmh = 9 } child:walk_to{ x = 5, y = 6 } child:walk_to{ across = 'east_1' }
        hand:control{ throttle = 0.5, steer = -1, reverse = true }
        set_weather 'hard_rain_sunset'
        ego:despawn())"));
    stage.play(1);
    const auto& commands = stage.commands;
    const std::size_t before = commands.size();
    stage.play(1);
    ASSERT_EQ(commands.size(), before + 12);
    const auto* said = &commands[before];
    EXPECT_DOUBLE_EQ(said[0].speed, 10);
    EXPECT_EQ(said[0].duration, 2);
    EXPECT_EQ(said[1].kind, CommandKind::free_speed);
    EXPECT_THAT(said[2].lanes, ElementsAre(2));
    EXPECT_EQ(said[2].duration, 2.5);
    EXPECT_THAT(said[3].lanes, ElementsAre(1));
    EXPECT_THAT(said[4].lanes, ElementsAre(2, 4));
    EXPECT_EQ(said[5].target, world::Vec3(3, 4, 0));
    EXPECT_DOUBLE_EQ(said[5].speed, 2.5);
    EXPECT_EQ(said[6].target, world::Vec3(5, 6, 0));
    // From the southern sidewalk across four lanes of 3.5 m, and one metre on.
    EXPECT_NEAR(said[7].target.x(), 50, 1e-9);
    EXPECT_NEAR(said[7].target.y(), 8, 1e-9);
    EXPECT_EQ(said[8].control, world::Control(0.5, 0, -1, 3, 0, false, true));
    EXPECT_EQ(said[9].kind, CommandKind::set_weather);
    EXPECT_LT(said[9].road_friction, 1);
    EXPECT_EQ(said[10].kind, CommandKind::despawn);
    EXPECT_EQ(said[11].kind, CommandKind::finish);
}

TEST(Handle, MeasuresBetweenActors) {
    EXPECT_THAT(printed(R"(
        local a = spawn{ model = 'sedan', lane = 'east_1', s = 20, speed = 10 }
        local b = spawn{ model = 'sedan', lane = 'east_1', s = 50, speed = 5 }
        print(string.format('%.3f %.3f %.3f', gap(a, b), distance(a, b), ttc(a, b))))"),
                // One tick later 0.25 m less of the 30 m; a sedan is 4.70 m long.
                ElementsAre("25.050 29.750 5.010"));
}

TEST(Places, PickLaneFollowsTheSeedAndTheWish) {
    EXPECT_THAT(
        printed("print(pick_lane{ left = true, sidewalk = true } == pick_lane{ left = true }, "
                "pick_lane{ lanes = 3, optional = true }, lane_length(pick_lane{}), "
                "lane_left_of('east_1'), lane_right_of('east_1'), lane_width('east_1'))")
            .size(),
        1U);
    const std::string picks =
        "for i = 1, 20 do print(pick_lane{}, pick_lane{ sidewalk = true }) end";
    EXPECT_EQ(printed(picks), printed(picks));
    EXPECT_THAT(printed(picks), testing::Each(testing::HasSubstr("t_1")));
    EXPECT_THAT(printed("print(lane_point('west_1', 100, 1.25))"),
                ElementsAre("300.0 4.0 0.0 180.0"));
}

TEST(Streams, AreIndependentAndRepeatable) {
    const auto once =
        printed("print(random()) print(random('a')) print(random()) print(random_int(1, 6, 'a'))");
    EXPECT_EQ(
        once,
        printed("print(random()) print(random('a')) print(random()) print(random_int(1, 6, 'a'))"));
    // A draw more in another stream moves nothing.
    const auto other = printed("print(random()) print(random('a')) random('b') print(random())");
    EXPECT_EQ(once[2], other[2]);
    EXPECT_THAT(printed("for i = 1, 200 do local n = random_int(-2, 3) assert(n >= -2 and n <= 3) "
                        "end print 'ok'"),
                ElementsAre("ok"));
}

}  // namespace reprise::scripting
