#include "world/town.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/support/worlds.h"

namespace reprise {

namespace {

using world::LaneKind;
using world::LaneT;

/// A quarter circle to the left around the origin, from (radius, 0), and uphill.
LaneT quarter_circle(double radius, int segments = 24) {
    std::vector<world::Vec3> points;
    for (int i = 0; i <= segments; ++i) {
        const double angle = std::numbers::pi / 2 * i / segments;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.1 * i);
    }
    return test::lane("bend_0", LaneKind::driving, points);
}

}  // namespace

TEST(PointAt, WalksAlongTheCentreLine) {
    const LaneT lane = test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {30, 0, 0}, {30, 40, 0}});
    EXPECT_TRUE(world::point_at(lane, 12).position.isApprox(Eigen::Vector3d(12, 0, 0)));
    EXPECT_TRUE(world::point_at(lane, 50).position.isApprox(Eigen::Vector3d(30, 20, 0)));
    EXPECT_DOUBLE_EQ(world::point_at(lane, 12).yaw, 0);
    EXPECT_DOUBLE_EQ(world::point_at(lane, 50).yaw, std::numbers::pi / 2);
}

TEST(PointAt, ClampsToTheLane) {
    const LaneT lane = test::lane("l_0", LaneKind::driving, {{5, 1, 0}, {30, 1, 0}});
    EXPECT_EQ(world::point_at(lane, -7).position, Eigen::Vector3d(5, 1, 0));
    EXPECT_EQ(world::point_at(lane, 1000).position, Eigen::Vector3d(30, 1, 0));
}

TEST(PointAt, PitchesUphill) {
    const LaneT lane = test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {4, 0, 3}});
    EXPECT_DOUBLE_EQ(world::point_at(lane, 2.5).pitch, std::atan2(3, 4));
    EXPECT_TRUE(world::point_at(lane, 2.5).position.isApprox(Eigen::Vector3d(2, 0, 1.5)));
}

TEST(Project, UndoesPointAt) {
    const LaneT lane = quarter_circle(20);
    for (double s = 0.1; s < lane.length; s += 0.37)
        for (const double t : {-2.0, -0.3, 0.0, 0.3, 2.0}) {
            const world::LanePoint at = world::point_at(lane, s);
            const Eigen::Vector3d left(-std::sin(at.yaw), std::cos(at.yaw), 0);
            const auto back = world::project(lane, at.position + t * left);
            // Across a corner of the polyline s may slip by t times the corner's angle.
            EXPECT_NEAR(back.s, s, 0.15);
            EXPECT_NEAR(back.t, t, 0.01);
            EXPECT_NEAR(back.distance, std::abs(t), 0.01);
        }
}

TEST(Project, MeasuresDistanceInThreeDimensions) {
    const LaneT lane = test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {30, 0, 0}});
    const auto at = world::project(lane, {10, 3, 4});
    EXPECT_DOUBLE_EQ(at.s, 10);
    EXPECT_DOUBLE_EQ(at.t, 3);
    EXPECT_DOUBLE_EQ(at.distance, 5);
}

TEST(Project, StaysWithinTheLane) {
    const LaneT lane = test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {30, 0, 0}});
    const auto behind = world::project(lane, {-4, 3, 0});
    EXPECT_DOUBLE_EQ(behind.s, 0);
    EXPECT_DOUBLE_EQ(behind.t, 3);
    EXPECT_DOUBLE_EQ(behind.distance, 5);
    EXPECT_DOUBLE_EQ(world::project(lane, {34, -3, 0}).s, 30);
}

TEST(Project, ChangesSmoothlyAroundACorner) {
    const LaneT lane = test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}});
    double last = world::project(lane, {9.9, -3, 0}).t;
    for (double angle = -90; angle <= 0; angle += 1) {
        const double radians = angle * std::numbers::pi / 180;
        const double t =
            world::project(lane, {10 + 3 * std::cos(radians), 3 * std::sin(radians), 0}).t;
        EXPECT_NEAR(t, last, 1e-6);
        last = t;
    }
    EXPECT_NEAR(last, -3, 1e-6);
}

TEST(FindLane, FindsEveryLaneAndNothingElse) {
    const world::TownT town = test::t_junction();
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        EXPECT_EQ(world::find_lane(town, town.lanes[i].name), i);
    for (const char* name : {"", "a", "west_in", "west_in_10", "zzz"})
        EXPECT_FALSE(world::find_lane(town, name)) << name;
    EXPECT_FALSE(world::find_lane(world::TownT(), "west_in_1"));
}

TEST(CurveRadius, IsThatOfTheCircle) {
    for (const double radius : {6.0, 25.0, 300.0}) {
        const LaneT lane = quarter_circle(radius);
        for (const double share : {0.0, 0.3, 0.99})
            EXPECT_NEAR(world::curve_radius(lane, share * lane.length), radius, radius * 1e-6);
    }
}

TEST(CurveRadius, IsLargeWhenStraight) {
    const LaneT two_points = test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {30, 0, 0}});
    const LaneT crest =
        test::lane("l_0", LaneKind::driving, {{0, 0, 0}, {30, 0, 3}, {60, 0, 0}, {61, 0, 0}});
    EXPECT_GE(world::curve_radius(two_points, 10), 1e5);
    EXPECT_GE(world::curve_radius(crest, 30), 1e5);
}

}  // namespace reprise
