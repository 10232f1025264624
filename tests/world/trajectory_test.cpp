#include "world/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace reprise::world {
namespace {

PathPoint point(double time, double x, double y, double heading = 0) {
    return {Vec3(x, y, 0), heading, time};
}

TEST(Trajectory, PassesEveryPointAtItsTime) {
    const std::vector<PathPoint> points{
        point(0, 0, 0), point(0.7, 5, 1), point(2, 5, 3), point(2.1, 4, 3.5), point(9, 60, -8)};
    const Trajectory way(points, false);
    for (const PathPoint& p : points) {
        EXPECT_DOUBLE_EQ(way.at(p.time()).position.x(), p.position().x());
        EXPECT_DOUBLE_EQ(way.at(p.time()).position.y(), p.position().y());
    }
}

TEST(Trajectory, NeverLeavesTheRangeBetweenTwoPoints) {
    const std::vector<PathPoint> points{
        point(0, 0, 0), point(1, 10, 0), point(2, 10, 0.1), point(3, 11, 8), point(4, -5, 8)};
    const Trajectory way(points, false);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (double share = 0; share <= 1; share += 0.01) {
            const auto p = way.at(points[i].time() + share).position;
            const auto [low_x, high_x] =
                std::minmax({points[i].position().x(), points[i + 1].position().x()});
            const auto [low_y, high_y] =
                std::minmax({points[i].position().y(), points[i + 1].position().y()});
            EXPECT_GE(p.x(), low_x - 1e-12);
            EXPECT_LE(p.x(), high_x + 1e-12);
            EXPECT_GE(p.y(), low_y - 1e-12);
            EXPECT_LE(p.y(), high_y + 1e-12);
        }
}

TEST(Trajectory, IsPassedAtAnEvenSpeedWhereItsPointsAre) {
    std::vector<PathPoint> points;
    for (const double time : {0.0, 0.5, 2.0, 2.1, 4.0})
        points.push_back(point(time, 3 * time, 4 * time));
    const Trajectory way(points, false);
    for (double time = 0; time <= 4; time += 0.05) {
        EXPECT_NEAR(way.at(time).position.x(), 3 * time, 1e-12);
        EXPECT_NEAR(way.at(time).velocity.norm(), 5, 1e-12);
        EXPECT_NEAR(*way.at(time).heading, std::atan2(4, 3), 1e-12);
        EXPECT_NEAR(way.at(time).turn_rate, 0, 1e-12);
    }
}

/// Velocity and turn rate against differences of what they are the rates of.
TEST(Trajectory, TellsItsOwnRates) {
    std::vector<PathPoint> points;
    for (double time = 0; time < 6; time += 0.5)
        points.push_back(point(time, 20 * std::sin(time / 3), 20 - 20 * std::cos(time / 3)));
    const Trajectory way(points, false);
    constexpr double h = 1e-5;
    for (double time = 0.117; time < 5.3; time += 0.13) {
        const auto before = way.at(time - h);
        const auto behind = way.at(time + h);
        const Eigen::Vector2d rate = (behind.position - before.position).head<2>() / (2 * h);
        EXPECT_NEAR((way.at(time).velocity - rate).norm(), 0, 1e-4);
        EXPECT_NEAR(way.at(time).turn_rate, (*behind.heading - *before.heading) / (2 * h), 1e-4);
    }
}

TEST(Trajectory, TurnsTheShorterWayBetweenHeadings) {
    const double degree = std::numbers::pi / 180;
    const std::vector<PathPoint> points{point(0, 0, 0, 170 * degree),
                                        point(2, 1, 0, -170 * degree)};
    const Trajectory way(points, true);
    EXPECT_NEAR(std::abs(*way.at(1).heading), std::numbers::pi, 1e-9);
    EXPECT_NEAR(way.at(1).turn_rate, 10 * degree, 1e-9);
}

TEST(Trajectory, HasNoHeadingWhereItStands) {
    const std::vector<PathPoint> points{point(0, 0, 0), point(1, 0, 0), point(2, 0, 5)};
    const Trajectory way(points, false);
    EXPECT_FALSE(way.at(0.5).heading.has_value());
    EXPECT_NEAR(*way.first_heading(), std::numbers::pi / 2, 1e-12);
    EXPECT_NEAR(*way.at(1.5).heading, std::numbers::pi / 2, 1e-12);
}

TEST(Trajectory, KnowsItsLastTick) {
    const std::vector<PathPoint> points{point(0, 0, 0), point(1.23, 5, 0)};
    EXPECT_EQ(last_tick_of(points, 0.05), 24U);
    const std::vector<PathPoint> whole{point(0, 0, 0), point(0.35, 5, 0)};
    EXPECT_EQ(last_tick_of(whole, 0.05), 7U);
}

}  // namespace
}  // namespace reprise::world
