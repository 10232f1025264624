#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/check.h"

// Where actors are put, and trajectories: what the words refuse, and what they say.
namespace reprise::scripting {
namespace {

struct Mistake {
    const char* body;
    const char* message;
};

constexpr const char* cast_of_four =
    "local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 20 } "
    "local child = spawn{ name = 'child', model = 'child', lane = 'east_0', s = 20 } "
    "local van = spawn{ name = 'van', model = 'van', driver = 'parked', lane = 'east_1', s = 60 } "
    "local car = spawn{ name = 'car', model = 'sedan', driver = 'traffic', lane = 'east_1', s = 90 "
    "} "
    "wait_ticks(2)\n";

void expect(const std::vector<Mistake>& table) {
    for (const auto& [body, message] : table)
        EXPECT_EQ(test::mistake(std::string(cast_of_four) + body),
                  std::string("test.lua:2: ") + message)
            << body;
}

}  // namespace

TEST(PlacingMistakes, OfTrajectories) {
    expect({
        {"ego:follow()",
         "follow: needs a list of points, the name of a file or false, got no value: ego:follow{ { "
         "t = 2, x = 10, y = 3 }, ... }"},
        {"ego:follow{}",
         "follow: needs points: ego:follow{ { t = 2, x = 10, y = 3 }, { t = 4, ... } }"},
        {"ego:follow{ 3 }", "follow: point 1 must be a table { t =, x =, y = }"},
        {"ego:follow{ { x = 3, y = 3 } }",
         "follow: point 1: 't' is missing: { t = 2, x = 10, y = 3 }"},
        {"ego:follow{ { t = 1, x = 3 } }", "follow: point 1: needs x and y, or lane, s and offset"},
        {"ego:follow{ { t = 1, x = 3, y = 'far' } }",
         "follow: point 1: 'y' must be a number, got 'far'"},
        {"ego:follow{ { t = 1, x = 3, y = 3, heading = 3 } }",
         "follow: point 1: unknown key 'heading' (did you mean 'heading_deg'?)"},
        {"ego:follow{ { t = 1, lane = 'eats_1' } }",
         "no lane 'eats_1' in straight_road (did you mean 'east_1'?)"},
        {"ego:follow{ { t = 1, lane = 'east_1', s = 500 } }",
         "follow: point 1: 's' must be in [0, 400.00], the length of 'east_1', got 500.0"},
        {"ego:follow{ { t = 2, x = 30, y = 0 }, { t = 2, x = 40, y = 0 } }",
         "follow: point 2: t = 2.0 is not later than t = 2.0 of point 1"},
        {"ego:follow{ { t = -1, x = 30, y = 0 } }",
         "follow: point 1: t = -1.0 is before now; with from = 'start' times are those of time()"},
        {"ego:follow({ { t = 0.05, x = 30, y = 0 } }, { from = 'start' })",
         "follow: the trajectory ends at t = -0.05 s, before the next tick: nothing is left of it"},
        {"ego:follow({ { t = 1, x = 30, y = 0 } }, { from = 'strat' })",
         "follow: 'from' must be 'now' or 'start', got 'strat' (did you mean 'start'?)"},
        {"ego:follow({ { t = 1, x = 30, y = 0 } }, { teleport = true })",
         "follow: 'teleport' needs a point at t = 0, point 1 has t = 1.0"},
        {"ego:follow{ { t = 1, x = 300, y = 0 } }",
         "follow: from where it is to point 1 'ego' would go 280.0 m in 1.0 s, 280.0 m/s: at most "
         "150.0 m/s"},
        {"van:follow{ { t = 1, x = 30, y = 0 } }", "follow: 'van' is parked, and never moves"},
        {"ego:follow 'lead.csv'",
         "follow: no file 'lead.csv' came with the scenario: it must lie beside it, end in .csv, "
         "and be named in the script or a parameter"},
        {"ego:follow '../lead.csv'",
         "follow: '../lead.csv' must be the plain name of a file beside the scenario, such as "
         "'lead.csv'"},
        {"check.never('x', function() ego:follow(false) return false end) wait(1)",
         "a check may look, but not act or wait"},
        {"ego:follow{ { t = 1, x = 30, y = 0 } } ego:set_velocity(3)",
         "set_velocity: 'ego' follows a trajectory until 1.10 s: end it first with "
         "ego:follow(false)"},
    });
    EXPECT_THAT(
        test::mistake(std::string(cast_of_four) + "ego:follow{ { t = 0, x = 30, y = 0 }, { t = "
                                                  "2, x = 40, y = 0 } }"),
        testing::HasSubstr("m from (30.00, 0.00), where the trajectory is at 0.10 s: leave "
                           "out the point at t = 0, so that it begins where 'ego' is, or "
                           "say { teleport = true }"));
    EXPECT_THAT(
        test::mistake(std::string(cast_of_four) + "car:follow{ { t = 9, x = 100, y = 90 } }"),
        testing::HasSubstr("on no lane that leads its way: driver = 'traffic' has to drive on"));
}

TEST(PlacingMistakes, OfPlaces) {
    expect({
        {"ego:teleport()", "teleport: the argument must be a table { key = value }, got nothing"},
        {"ego:teleport{ speed = 3 }",
         "teleport: needs a place: { lane =, s =, offset = }, { x =, y =, heading_deg = } or { "
         "ahead_of =, gap = }"},
        {"ego:teleport{ lane = 'eats_1' }",
         "teleport: no lane 'eats_1' in straight_road (did you mean 'east_1'?)"},
        {"ego:teleport{ x = 3, y = 2 }",
         "teleport: 'heading_deg' is missing: a pose needs x, y and heading_deg"},
        {"ego:teleport{ x = 3, heading_deg = 2 }",
         "teleport: 'y' is missing: a pose needs x, y and heading_deg"},
        {"ego:teleport{ x = 3e5, y = 0, heading_deg = 2 }",
         "teleport: (3e+05, 0.0) is more than 1 km from every road of straight_road"},
        {"ego:teleport{ lane = 'east_1', s = 3, x = 3 }",
         "teleport: give a lane or a pose (x, y, heading_deg), not both"},
        {"ego:teleport{ lane = 'east_1', s = 91 }",
         "teleport: 'ego' would stand in 'car', which line 1 spawned: they reach 1.82 m into each "
         "other; move one of them by 's' or 'offset'"},
        {"van:teleport{ lane = 'east_1', s = 200 }", "teleport: 'van' is parked, and never moves"},
        {"child:teleport{ x = 20, y = 3, speed = 2 }",
         "teleport: 'speed' has no effect on 'child', a walker: child:set_velocity(1.5) while it "
         "walks"},
        {"car:teleport{ lane = 'east_1', s = 200, offset = 1 }",
         "teleport: 'offset' has no effect on 'car': driver = 'traffic' keeps to the middle of its "
         "lane; leave it out, or take driver = 'autopilot'"},
        {"ego:teleport{ ahead_of = ego, gap = 3 }",
         "teleport: 'ahead_of' = 'ego' is the actor itself"},
        {"spawn{ model = 'sedan', ahead_of = ego }",
         "spawn: 'gap' is missing: metres from bumper to bumper, ahead_of = ego, gap = 30"},
        {"spawn{ model = 'sedan', ahead_of = ego, gap = -3 }",
         "spawn: 'gap' must be in [0, 10000] m, got -3.0"},
        {"spawn{ model = 'sedan', ahead_of = ego, gap = 3, behind = ego }",
         "spawn: give 'ahead_of' or 'behind', not both"},
        {"spawn{ model = 'sedan', ahead_of = ego, gap = 3, lane = 'lfet' }",
         "spawn: 'lane' must be 'left', 'right' or 'same' of 'ego' with 'ahead_of', got 'lfet' "
         "(did "
         "you mean 'left'?)"},
        {"spawn{ model = 'sedan', ahead_of = ego, gap = 3, s = 4 }",
         "spawn: 's' has no effect with 'ahead_of'"},
        {"spawn{ model = 'sedan', beside = ego }",
         "spawn: 'beside' needs lane = 'left' or lane = 'right'"},
        {"spawn{ model = 'sedan', gap = 3 }", "spawn: 'gap' needs 'ahead_of' or 'behind'"},
        {"ego:set_velocity()", "set_velocity: the speed must be a number, got nothing"},
        {"ego:set_velocity(200)",
         "set_velocity: the speed of 'ego' must be in [-150.0, 150.0] m/s, got 200.0"},
        {"car:set_velocity(-1)",
         "set_velocity: the speed of 'car' must be in [0.0, 150.0] m/s, got -1.0"},
        {"child:set_velocity(1)",
         "set_velocity: has no effect on 'child', which stands until it is told where to go: "
         "child:walk{ to = { x, y } }"},
    });
}

// --- Files.

/// The message of the first mistake of a script that follows this file.
std::string mistake_in_csv(const std::string& text) {
    test::Stage stage(test::running(cast_of_four + std::string("ego:follow 'lead.csv' wait(1)")));
    world::FileT file;
    file.name = "lead.csv";
    file.text = text;
    stage.episode.files.push_back(file);
    try {
        stage.play(40);
    } catch (const world::Error& error) {
        return error.what();
    }
    return "";
}

TEST(PlacingMistakes, OfFilesNameTheirLine) {
    const std::string prefix = "test.lua:2: follow: lead.csv";
    EXPECT_EQ(mistake_in_csv(""), prefix + ": is empty");
    EXPECT_EQ(mistake_in_csv("t,x,y\n"), prefix + ": holds no point");
    EXPECT_EQ(mistake_in_csv("t,x\n1,2\n"), prefix + ":1: no column 'y'");
    EXPECT_EQ(mistake_in_csv("t,x,y,heading\n1,2,3,4\n"),
              prefix +
                  ":1: no column 'heading' (did you mean 'heading_deg'?); the first line names "
                  "the columns: t, x, y and, where it is known, heading_deg");
    EXPECT_EQ(mistake_in_csv("t,x,y,x\n"), prefix + ":1: column 'x' twice");
    EXPECT_EQ(mistake_in_csv("t,x,y\n1,30,0\n\n2,4O,0\n"),
              prefix + ":4: 'x' must be a number, got '4O'");
    EXPECT_EQ(mistake_in_csv("t,x,y\n1,30\n"), prefix + ":2: 2 values for 3 columns");
    EXPECT_EQ(mistake_in_csv("t,x,y\n2,30,0\n1,40,0\n"),
              prefix + ":3: t = 1.0 is not later than t = 2.0 of lead.csv:2");
    EXPECT_EQ(mistake_in_csv("t,x,y\n1,nan,0\n"), prefix + ":2: 'x' must be a number, got 'nan'");
}

TEST(Follow, ReadsAFileInAnyOrderOfColumns) {
    test::Stage stage(test::running(cast_of_four + std::string("ego:follow 'lead.csv' wait(1)")));
    world::FileT file;
    file.name = "lead.csv";
    file.text = "\xef\xbb\xbfy, t ,x,heading_deg\r\n0,1,30,0\r\n0.5, 2, 40,\r\n";
    stage.episode.files.push_back(file);
    stage.play(5);
    const world::CommandT& command = stage.commands.back();
    ASSERT_EQ(command.kind, world::CommandKind::follow);
    ASSERT_EQ(command.path.size(), 3U) << "it begins where it is";
    EXPECT_EQ(command.path[0].time(), 0);
    EXPECT_EQ(command.path[1].time(), 1);
    EXPECT_EQ(command.path[1].position().x(), 30);
    EXPECT_EQ(command.path[2].position().y(), 0.5);
    EXPECT_TRUE(command.has_pose) << "one heading is said; the other follows from the way";
}

}  // namespace reprise::scripting
