#include "scripting/run/measures.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::scripting {

namespace {

/// 4 m long, 2 m wide, its position 1 m before the rear bumper.
Body car(double x, double y, double yaw = 0, double speed = 0, std::uint32_t lane = world::none) {
    Body body;
    body.position = {x, y, 0};
    body.yaw = yaw;
    body.speed = speed;
    body.front = 3;
    body.rear = 1;
    body.half_width = 1;
    body.lane = lane;
    return body;
}

/// Two 100 m lanes, one behind the other around a right angle, joined by nothing.
world::TownT corner() {
    world::TownT town = test::straight_road(100, 1);
    world::LaneT& second = town.lanes[3];
    second.edge = "north";
    second.centre = {world::Vec3(100, -1.75, 0), world::Vec3(100, 98.25, 0)};
    town.lanes[1].opposite = world::none;
    town.lanes[1].links.emplace_back(
        3U, world::none, world::none, world::Turn::left, false, std::uint16_t{0});
    return town;
}

}  // namespace

TEST(Measures, GapIsFromBumperToBumperWhicheverIsAhead) {
    const world::TownT town = test::straight_road(400, 2);
    const Gap ahead = gap(town, car(10, 0), car(30, 0));
    EXPECT_DOUBLE_EQ(ahead.length, 30 - 1 - (10 + 3));
    EXPECT_TRUE(ahead.ahead);
    const Gap behind = gap(town, car(30, 0), car(10, 0));
    EXPECT_DOUBLE_EQ(behind.length, ahead.length);
    EXPECT_FALSE(behind.ahead);
    EXPECT_EQ(gap(town, car(10, 0), car(12, 3)).length, 0);
}

TEST(Measures, GapAlongTheRoadAgreesWithTheLineWhereItIsStraight) {
    const world::TownT town = test::straight_road(400, 2);
    const Gap line = gap(town, car(10, -5.25), car(60, -1.75));
    const Gap road = gap(town, car(10, -5.25, 0, 0, 1), car(60, -1.75, 0, 0, 2));
    EXPECT_DOUBLE_EQ(line.length, road.length);
    EXPECT_EQ(line.ahead, road.ahead);
}

TEST(Measures, GapFollowsTheRoadAroundACorner) {
    const world::TownT town = corner();
    const double half_turn = std::acos(-1.0) / 2;
    const Body a = car(80, -1.75, 0, 10, 1);
    // Along the road 20 m to the corner and 28 m on; the heading at right angles still counts.
    const Body b = car(100, 26.25, half_turn - 1e-9, 0, 3);
    EXPECT_NEAR(gap(town, a, b).length, 48 - 3 - 1, 1e-6);
    EXPECT_NEAR(gap(town, b, a).length, 48 - 3 - 1, 1e-6);
    EXPECT_FALSE(gap(town, b, a).ahead);
}

TEST(Measures, TimeToCollisionIsGapOverClosingSpeed) {
    const world::TownT town = test::straight_road(400, 2);
    EXPECT_DOUBLE_EQ(time_to_collision(town, car(10, 0, 0, 15), car(34, 0, 0, 5)), 2);
    EXPECT_DOUBLE_EQ(time_to_collision(town, car(34, 0, 0, 5), car(10, 0, 0, 15)), 2);
    EXPECT_TRUE(std::isinf(time_to_collision(town, car(10, 0, 0, 5), car(34, 0, 0, 5))));
    const double pi = std::acos(-1.0);
    EXPECT_DOUBLE_EQ(time_to_collision(town, car(10, 0, 0, 5), car(36, 0, pi, 5)), 2);
}

TEST(Measures, DistanceIsBetweenTheMiddlesOfTheBoxes) {
    EXPECT_DOUBLE_EQ(distance(car(0, 0), car(0, 0, std::acos(-1.0))), 2);
    EXPECT_DOUBLE_EQ(distance(car(0, 0), car(3, 4)), 5);
}

}  // namespace reprise::scripting
