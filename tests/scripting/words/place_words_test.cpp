#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "tests/support/places.h"

namespace reprise::scripting {

using test::mistake;
using test::printed;
using testing::ElementsAre;

namespace {

/// A road from the west that parts at x = 100: to the left, slightly left, straight on, back.
world::TownT parting() {
    world::TownT town = test::straight_road(100, 1);
    const auto add = [&](const char* name, double x, double y) {
        town.lanes.push_back(test::lane(
            name, world::LaneKind::driving, {world::Vec3(100, -1.75, 0), world::Vec3(x, y, 0)}));
        town.lanes.back().edge = name;
    };
    add("x_left", 100, 98);
    add("x_slight", 180, 60);
    add("x_straight", 200, -1.75);
    const auto link = [](std::uint32_t to, world::Turn turn) {
        return world::Link(to, world::none, world::none, turn, false, 0);
    };
    town.lanes[1].links = {link(3, world::Turn::around),
                           link(4, world::Turn::left),
                           link(5, world::Turn::partially_left),
                           link(6, world::Turn::straight)};
    return town;
}

std::vector<std::string> printed_at_parting(const std::string& body) {
    test::Stage stage(test::running(body), parting());
    return stage.play(5);
}

}  // namespace

TEST(LaneAt, UndoesLanePoint) {
    EXPECT_THAT(printed(R"(
        for _, place in ipairs{ { 'east_1', 40, 0.5 }, { 'west_2', 40, -1 }, { 'east_0', 10, 1 } } do
            local x, y, z = lane_point(table.unpack(place))
            print(lane_at(x, y))
            print(lane_at(x, y, z))
        end)"),
                ElementsAre("east_1 40.0 0.5",
                            "east_1 40.0 0.5",
                            "west_2 40.0 -1.0",
                            "west_2 40.0 -1.0",
                            "east_0 10.0 1.0",
                            "east_0 10.0 1.0"));
}

TEST(LaneAt, IsNilWhereNoLaneIs) {
    EXPECT_THAT(printed("print(lane_at(40, 60)) print(lane_at(-10, 0)) print(lane_at(40, -5, 20))"),
                ElementsAre("nil", "nil", "nil"));
}

TEST(LaneAt, WithoutAHeightIsTheUppermostRoad) {
    test::Stage stage(test::running("print(lane_at(0, 0)) print(lane_at(0, 0, 0)) "
                                    "print(lane_at(0, 0, 6.5))"),
                      test::bridge());
    const auto lines = stage.play(3);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], lines[2]);
    EXPECT_NE(lines[0], lines[1]);
}

TEST(LaneNext, IsTheLaneBehindInThatDirection) {
    EXPECT_THAT(printed_at_parting(R"(
        print(lane_next('east_1', 'left'), lane_next('east_1', 'straight'), lane_next('east_1', 'right'),
              lane_next('east_1', 'turnaround'))
        print(table.concat(lane_next 'east_1', ' '), #lane_next 'x_left'))"),
                ElementsAre("x_left x_straight nil west_1", "west_1 x_left x_slight x_straight 0"))
        << "a turn goes before a bend";
}

TEST(Places, SayWhatIsWrong) {
    EXPECT_EQ(mistake("lane_at(3)"), "test.lua:1: lane_at: y must be a number, got nothing");
    EXPECT_EQ(mistake("lane_next('east_1', 'lef')"),
              "test.lua:1: lane_next: no direction 'lef' (did you mean 'left'?): 'left', 'right', "
              "'straight' or 'turnaround'");
    EXPECT_EQ(mistake("lane_next 'east_11'"),
              "test.lua:1: no lane 'east_11' in straight_road (did you mean 'east_1'?)");
    EXPECT_EQ(mistake("lane_junction()"),
              "test.lua:1: lane_junction: the lane must be a string, got nothing");
    EXPECT_EQ(mistake("pick_junction{ lit = true, arms = 4 }"),
              "test.lua:1: pick_junction: straight_road has no junction with lit = true, arms = 4");
    EXPECT_EQ(mistake("pick_junction{ arms = 2 }"),
              "test.lua:1: pick_junction: 'arms' must be 3 or more, got 2");
    EXPECT_EQ(mistake("pick_junction{ light = true }"),
              "test.lua:1: pick_junction: unknown key 'light' (did you mean 'lit'?)");
    EXPECT_EQ(mistake("pick_crossing{ lit = 3 }"),
              "test.lua:1: pick_crossing: 'lit' must be true or false, got 3");
    EXPECT_EQ(mistake("pick_crossing()"),
              "test.lua:1: pick_crossing: straight_road has no pedestrian crossing");
    EXPECT_THAT(printed("print(pick_junction{ optional = true }, pick_crossing{ optional = true }, "
                        "lane_junction 'east_1')"),
                ElementsAre("nil nil nil"));
}

}  // namespace reprise::scripting
