#include "world/lanes/planner.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/support/worlds.h"

namespace reprise::world {
namespace {

std::uint32_t lane_of(const TownT& town, const char* name) {
    const auto lane = find_lane(town, name);
    EXPECT_TRUE(lane) << name;
    return lane.value_or(0);
}

void link(TownT& town, const char* from, const char* via, const char* to, Turn turn) {
    const std::uint32_t inside = lane_of(town, via);
    const std::uint32_t target = lane_of(town, to);
    town.lanes[lane_of(town, from)].links.emplace_back(
        target, inside, none, turn, false, std::uint16_t{0});
    town.lanes[inside].links.emplace_back(target, none, none, turn, false, std::uint16_t{0});
}

/// Arms to the west, east and south of (50, -4); all turns.
TownT linked_t() {
    TownT town = test::t_junction();
    link(town, "west_in_1", ":t_0_0", "east_out_1", Turn::straight);
    link(town, "west_in_1", ":t_1_0", "south_out_1", Turn::right);
    link(town, "east_in_1", ":t_2_0", "west_out_1", Turn::straight);
    link(town, "east_in_1", ":t_3_0", "south_out_1", Turn::left);
    link(town, "south_in_1", ":t_4_0", "east_out_1", Turn::right);
    link(town, "south_in_1", ":t_5_0", "west_out_1", Turn::left);
    return town;
}

/// "follow_lane 0, left 15, ...": the steps with the metres where they begin.
std::string story(const Route& route) {
    std::string text;
    for (const Route::Step& step : route.steps)
        text += (text.empty() ? "" : ", ") + std::string(name_of(step.command)) + " " +
                std::to_string(std::lround(step.begins));
    return text;
}

TEST(Planner, SaysWhatToDoAtTheJunction) {
    const TownT town = linked_t();
    const Planner planner(town);
    const auto way = [&](const char* from, const char* to) {
        return planner.plan({lane_of(town, from), 5}, {lane_of(town, to), 20});
    };
    // The western lane is 40 m long; the junction is announced 25 m before its end.
    const auto straight = way("west_in_1", "east_out_1");
    ASSERT_TRUE(straight);
    EXPECT_NEAR(straight->length, 35 + 20 + 20, 1e-9);
    EXPECT_EQ(story(*straight), "follow_lane 0, straight 10, follow_lane 55, reach_goal 75");
    EXPECT_EQ(command_at(*straight, 9), RouteCommand::follow_lane);
    EXPECT_EQ(command_at(*straight, 30), RouteCommand::straight);
    EXPECT_EQ(way("west_in_1", "south_out_1")->steps[1].command, RouteCommand::right);
    EXPECT_EQ(way("east_in_1", "south_out_1")->steps[1].command, RouteCommand::left);
    EXPECT_EQ(way("south_in_1", "west_out_1")->steps[1].command, RouteCommand::left);
}

TEST(Planner, SaysNothingWhereThereIsNoChoice) {
    TownT town = linked_t();
    town.lanes[lane_of(town, "west_in_1")].links.resize(1);
    const auto route =
        Planner(town).plan({lane_of(town, "west_in_1"), 5}, {lane_of(town, "east_out_1"), 20});
    ASSERT_TRUE(route);
    EXPECT_EQ(story(*route), "follow_lane 0, reach_goal 75");
}

TEST(Planner, FindsNoWayWhereNoneLeads) {
    const TownT town = linked_t();
    const Planner planner(town);
    const std::uint32_t out = lane_of(town, "east_out_1");
    const std::uint32_t in = lane_of(town, "west_in_1");
    EXPECT_FALSE(planner.plan({out, 5}, {in, 5})) << "a dead end";
    EXPECT_FALSE(planner.plan({in, 20}, {in, 5})) << "back on a lane that no block goes around";
    EXPECT_FALSE(planner.cost({out, 5}, {in, 5}));
}

TEST(Planner, ChangesLanesBesideTheStart) {
    const TownT town = test::straight_road(400, 3);
    const auto route =
        Planner(town).plan({lane_of(town, "east_1"), 50}, {lane_of(town, "east_3"), 290});
    ASSERT_TRUE(route);
    EXPECT_EQ(
        driving_lanes(town, *route),
        (std::vector{lane_of(town, "east_1"), lane_of(town, "east_2"), lane_of(town, "east_3")}));
    EXPECT_NEAR(route->length, 240, 1e-9) << "a change of lanes costs, but is no way";
    EXPECT_EQ(story(*route), "follow_lane 0, reach_goal 240");
    for (std::size_t i = 1; i < route->pieces.size(); ++i)
        EXPECT_NEAR(route->pieces[i].from, route->pieces[i - 1].to, 1e-9);
    const auto line = centre_line(town, *route);
    EXPECT_NEAR(line.front().x(), 50, 1e-9);
    EXPECT_NEAR(line.back().x(), 290, 1e-9);
    EXPECT_NEAR(line.front().y(), town.lanes[lane_of(town, "east_1")].centre[0].y(), 1e-9);
    EXPECT_NEAR(line.back().y(), town.lanes[lane_of(town, "east_3")].centre[0].y(), 1e-9);
    EXPECT_TRUE(std::is_sorted(
        line.begin(), line.end(), [](const auto& p, const auto& q) { return p.x() < q.x(); }));
}

TEST(Planner, AChangeOfLanesCostsByItsRoomBeforeTheGoal) {
    const TownT town = test::straight_road(400, 3);
    const auto cost = [&](const char* lane, double s) {
        return Planner(town).cost({lane_of(town, "east_1"), 50}, {lane_of(town, lane), s}).value();
    };
    EXPECT_NEAR(cost("east_2", 150), 100 + 40, 1e-9);
    EXPECT_NEAR(cost("east_2", 80), 30 + 200, 1e-9);
    EXPECT_NEAR(cost("east_2", 60), 10 + 10'000, 1e-9);
    EXPECT_NEAR(cost("east_3", 150), 100 + 2 * 40, 1e-9);
    EXPECT_NEAR(cost("east_3", 110), 60 + 2 * 200, 1e-9);
}

TEST(Planner, KnowsHowFarTheGoalIs) {
    const TownT town = linked_t();
    const std::uint32_t from = lane_of(town, "west_in_1");
    const std::uint32_t inside = lane_of(town, ":t_1_0");
    const std::uint32_t to = lane_of(town, "south_out_1");
    const auto route = Planner(town).plan({from, 10}, {to, 30});
    ASSERT_TRUE(route);
    EXPECT_NEAR(*distance_to_goal(town, *route, {from, 10}), route->length, 1e-9);
    EXPECT_NEAR(*distance_to_goal(town, *route, {from, 30}), route->length - 20, 1e-9);
    EXPECT_NEAR(*distance_to_goal(town, *route, {inside, 0}), route->length - 30, 1e-9);
    EXPECT_NEAR(*distance_to_goal(town, *route, {to, 29}), 1, 1e-9);
    EXPECT_NEAR(*distance_to_goal(town, *route, {to, 40}), 0, 1e-9) << "past it";
    EXPECT_FALSE(distance_to_goal(town, *route, {lane_of(town, "east_out_1"), 1})) << "lost";
}

TEST(Planner, TheMiddleOfTheWayHasNoJumps) {
    const TownT town = linked_t();
    const auto route =
        Planner(town).plan({lane_of(town, "east_in_1"), 3}, {lane_of(town, "south_out_1"), 30});
    ASSERT_TRUE(route);
    const auto line = centre_line(town, *route);
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += (line[i] - line[i - 1]).norm();
    EXPECT_NEAR(length, route->length, 1e-9);
}

/// The same T seen in a mirror: y becomes -y, left becomes right.
TEST(Planner, LeftHandTrafficIsTheMirrorImage) {
    TownT town = linked_t();
    town.left_hand = true;
    for (LaneT& lane : town.lanes) {
        for (Vec3& p : lane.centre)
            p.mutate_y(-p.y());
        for (Link& way : lane.links)
            way.mutate_turn(way.turn() == Turn::left    ? Turn::right
                            : way.turn() == Turn::right ? Turn::left
                                                        : way.turn());
    }
    const TownT right_hand = linked_t();
    for (const char* from : {"west_in_1", "east_in_1", "south_in_1"})
        for (const char* to : {"west_out_1", "east_out_1", "south_out_1"}) {
            const auto mirrored =
                Planner(town).plan({lane_of(town, from), 5}, {lane_of(town, to), 9});
            const auto route =
                Planner(right_hand).plan({lane_of(town, from), 5}, {lane_of(town, to), 9});
            ASSERT_EQ(mirrored.has_value(), route.has_value());
            if (!route)
                continue;
            EXPECT_NEAR(mirrored->length, route->length, 1e-9);
            std::string expected = story(*route);
            for (const auto& [side, other] :
                 {std::pair("left", "RIGHT"), std::pair("right", "LEFT")})
                if (const auto at = expected.find(side); at != std::string::npos)
                    expected.replace(at, std::string(side).size(), other);
            std::transform(expected.begin(), expected.end(), expected.begin(), [](unsigned char c) {
                return static_cast<char>(std::tolower(c));
            });
            EXPECT_EQ(story(*mirrored), expected);
        }
}

}  // namespace
}  // namespace reprise::world
