// Mistakes of what drivers are told about speed and lateral motion, and what becomes a command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

namespace {

constexpr const char* ego =
    "local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 20, speed = 14 }\n";
constexpr const char* of_sumo =
    "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'traffic', "
    "lane = 'east_1', s = 20, speed = 14 }\n";
constexpr const char* child =
    "local ego = spawn{ name = 'ego', model = 'child', lane = 'east_0', s = 20 }\n";
constexpr const char* hand =
    "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'east_1' }\n";

std::string mistake(const char* who, const std::string& words) {
    return test::mistake(std::string(who) + words);
}

}  // namespace

TEST(MotionWords, SayWhatIsWrong) {
    struct Row {
        const char* who;
        const char* words;
        const char* message;
    };

    const std::vector<Row> table{
        {ego, "ego:hold_speed 'fast'", "hold_speed: the speed must be a number, got 'fast'"},
        {ego, "ego:hold_speed(-1)", "hold_speed: the speed must be in [0, 150] m/s, got -1.0"},
        {ego, "ego:hold_speed(90)", "hold_speed: 'ego' cannot drive at 90.0 m/s"},
        {ego,
         "ego:hold_speed(9, { ovr = 2 })",
         "hold_speed: unknown key 'ovr' (did you mean 'over'?)"},
        {child, "ego:hold_speed(1)", "hold_speed: 'ego' is a walker"},
        {hand,
         "ego:hold_speed(1)",
         "hold_speed: 'ego' is driven by hand: only 'autopilot', 'traffic' and walkers obey"},
        {ego, "ego:brake()", "brake: the deceleration in m/s^2 must be a number, got nothing"},
        {ego,
         "ego:brake(12)",
         "brake: the deceleration must be in (0, 9.5] m/s^2, what the brakes of 'ego' and the road "
         "give, got 12.0"},
        {child, "ego:brake(1)", "brake: 'ego' is a walker"},
        {ego,
         "ego:set_offset(9)",
         "set_offset: the offset must be in [-3.50, 3.50] m, what 'east_1' is wide, got 9.0"},
        {of_sumo,
         "ego:set_offset(2)",
         "set_offset: the offset must be in [-1.75, 1.75] m, for 'traffic' half of what 'east_1' "
         "is "
         "wide, got 2.0"},
        {ego,
         "ego:set_offset(1, { over = 0.2 })",
         "set_offset: 'ego' cannot move 1.0 m aside in 0.2 s at 14.0 m/s: it takes 0.9 s or more"},
        {ego,
         "ego:set_offset(1, { over = 2, shape = 'sinusodial' })",
         "set_offset: no shape 'sinusodial' (did you mean 'sinusoidal'?): 'sinusoidal', 'linear', "
         "'cubic' or 'step'"},
        {ego,
         "ego:set_offset(1, { shape = 'cubic' })",
         "set_offset: 'shape' needs 'over', the time of the whole change: over = 3"},
        {ego,
         "ego:set_offset(1, { over = 2, shape = 'step' })",
         "set_offset: 'over' has no effect with the shape 'step', which is as quick as can be"},
        {ego,
         "ego:change_lane('left', { over = 0.5 })",
         "change_lane: 'ego' cannot move 3.5 m aside in 0.5 s at 14.0 m/s: it takes 1.7 s or more"},
        {ego,
         "ego:change_lane('west_1', { over = 3 })",
         "change_lane: within a time only to a lane beside its own, which 'west_1' is not: leave "
         "'over' and 'shape' out"},
        {of_sumo,
         "ego:change_lane('left', { over = 3, shape = 'cubic' })",
         "change_lane: 'ego' is SUMO's, which goes over evenly: leave 'shape' out, or take driver "
         "= "
         "'autopilot'"},
        {ego,
         "ego:set_speed(30, { over = 1 })",
         "set_speed: 'ego' cannot get from 14.0 to 30.0 m/s in 1.0 s: it takes 7.8 s or more"},
        {ego,
         "ego:set_speed(9, { shape = 'step' })",
         "set_speed: nobody's speed changes by a step: leave 'shape' out, as fast as it likes"},
        {ego,
         "ego:ignore_lights(1)",
         "ignore_lights: takes true or false, true where it is left out"},
        {child, "ego:ignore_lights()", "ignore_lights: 'ego' is a walker"},
        {ego,
         "ego:may_overtake(1)",
         "may_overtake: takes true or false, true where it is left out"},
        {child, "ego:may_overtake()", "may_overtake: 'ego' is a walker"},
        {of_sumo,
         "ego:may_overtake()",
         "may_overtake: overtaking is for driver = 'autopilot': 'ego' is driven as 'traffic'"},
        {ego, "arrive_together(ego, ego, { 100, 0 })", "arrive_together: needs two actors"},
        {ego,
         "arrive_together(ego, 3, { 100, 0 })",
         "arrive_together: an actor is needed as argument 2, got number: write ego:speed(), "
         "gap(ego, other)"},
    };
    for (const auto& [who, words, message] : table)
        EXPECT_EQ(mistake(who, words), std::string("test.lua:2: ") + message) << words;
}

TEST(MotionWords, OfPointsToMeetAt) {
    const std::string both =
        std::string(ego) + "local b = spawn{ model = 'suv', lane = 'west_1', s = 20, speed = 9 } ";
    const auto meeting = [&](const std::string& point) {
        return test::mistake(both + "arrive_together(ego, b, " + point + ")");
    };
    const std::string form =
        "test.lua:2: arrive_together: the point must be { x, y } or { lane =, s "
        "= }, or one for each: { a =, b = }";
    EXPECT_EQ(meeting("nil"), form);
    EXPECT_EQ(meeting("{ lane = 'east_1' }"), form);
    EXPECT_EQ(meeting("{ lane = 'east_1', s = 999 }"),
              "test.lua:2: arrive_together: 's' must be in [0, 400.0] m, got 999");
    EXPECT_EQ(meeting("{ lane = 'eats_1', s = 9 }"),
              "test.lua:2: no lane 'eats_1' in straight_road (did you mean 'east_1'?)");
    EXPECT_EQ(
        meeting("{ 100, 999 }"),
        "test.lua:2: arrive_together: no lane for cars is at (100.0, 999.0), where 'ego' is to "
        "come");
    EXPECT_EQ(meeting("{ a = { lane = 'east_1', s = 200 }, b = { lane = 'east_1', s = 9 } }"),
              "test.lua:2: arrive_together: no way leads 'suv' to its point");
}

TEST(ArriveTogether, GivesUpAfterItsTimeoutOrWhenBothHaveStoodForAMinute) {
    const auto play = [](const std::string& options) {
        test::Stage stage(test::running(
            "local a = spawn{ model = 'sedan', lane = 'east_1', s = 20 }\n"
            "local b = spawn{ model = 'suv', lane = 'west_1', s = 20 }\n"
            "local met, apart = arrive_together(a, b, { a = { lane = 'east_1', s = 200 },\n"
            "    b = { lane = 'west_1', s = 200 } }" +
            options + ")\nprint(met, apart, time())"));
        return stage.play(1400);
    };
    // Asked from tick 1 on, in which both are there: a tick is 0.05 s.
    EXPECT_THAT(play(", { timeout = 2 }"), testing::ElementsAre("false inf 2.0"));
    EXPECT_THAT(play(""), testing::ElementsAre(testing::StartsWith("false inf 60")));
    EXPECT_EQ(mistake(ego,
                      "local b = spawn{ model = 'suv', lane = 'west_1', s = 20 }\n"
                      "arrive_together(ego, b, { a = { lane = 'east_1', s = 200 },\n"
                      "    b = { lane = 'west_1', s = 200 } }, { timeout = -1 })"),
              "test.lua:3: arrive_together: 'timeout' must be in [0, 1e9] s");
}

TEST(ArriveTogether, EndsWithAnErrorWhereOneOfThemLeavesTheWorld) {
    EXPECT_EQ(
        mistake(ego,
                "local b = spawn{ name = 'b', model = 'suv', lane = 'west_1', s = 20, speed = 1 }\n"
                "start(function() wait(1) b:despawn() end)\n"
                "arrive_together(ego, b, { a = { lane = 'east_1', s = 399 },\n"
                "    b = { lane = 'west_1', s = 399 } })"),
        "test.lua:4: 'b' left the world in tick 21: ask b:exists() first");
}

TEST(MotionWords, BecomeCommands) {
    test::Stage stage(test::running(std::string(ego) + R"(
        ego:hold_speed() ego:hold_speed_kmh(36, { over = 4 }) ego:hold_speed(false)
        ego:brake(6) ego:brake(false) ego:set_offset(-0.5, { over = 2, shape = 'cubic' })
        ego:change_lane('left', { over = 3 }) ego:ignore_lights() ego:ignore_lights(false)
        wait(1))"));
    stage.play(5);
    using world::CommandKind;
    std::vector<world::CommandT> said(stage.commands.begin() + 1, stage.commands.end());
    ASSERT_GE(said.size(), 9U);
    EXPECT_EQ(said[0].kind, CommandKind::hold_speed);
    EXPECT_TRUE(said[0].on);
    EXPECT_NEAR(said[0].speed, 14, 1e-6) << "as fast as it is";
    EXPECT_NEAR(said[1].speed, 10, 1e-9);
    EXPECT_EQ(said[1].duration, 4);
    EXPECT_EQ(said[1].shape, world::Shape::linear);
    EXPECT_FALSE(said[2].on);
    EXPECT_EQ(said[3].kind, CommandKind::brake);
    EXPECT_EQ(said[3].deceleration, 6);
    EXPECT_FALSE(said[4].on);
    EXPECT_EQ(said[5].kind, CommandKind::set_offset);
    EXPECT_EQ(said[5].offset, -0.5);
    EXPECT_EQ(said[5].shape, world::Shape::cubic);
    EXPECT_EQ(said[6].kind, CommandKind::change_lane);
    EXPECT_EQ(said[6].duration, 3);
    EXPECT_TRUE(said[7].on);
    EXPECT_FALSE(said[8].on);
}

}  // namespace reprise::scripting
