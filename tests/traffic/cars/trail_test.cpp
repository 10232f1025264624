#include "traffic/cars/trail.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace reprise::traffic {
namespace {

using Eigen::Vector3d;

TEST(Trail, RearFollowsStraightBehind) {
    Trail trail;
    trail.start(Vector3d(10, 0, 0), Vector3d(-1, 0, 0), 3.7);
    EXPECT_NEAR((trail.rear() - Vector3d(6.3, 0, 0)).norm(), 0, 1e-12);
    for (int i = 1; i <= 2000; ++i)
        trail.advance(Vector3d(10 + 0.07 * i, 0, 0));
    EXPECT_NEAR((trail.rear() - Vector3d(10 + 140 - 3.7, 0, 0)).norm(), 0, 1e-9);
}

TEST(Trail, RearPassesWhereTheFrontWas) {
    // A circle of 12 m: the rear axle is the same circle, an arc of 3.7 m behind, up to the points
    // kept every quarter metre.
    Trail trail;
    const double radius = 12;
    auto on_circle = [radius](double s) {
        return Vector3d(radius * std::cos(s / radius), radius * std::sin(s / radius), 0);
    };
    trail.start(on_circle(0), Vector3d(0, -1, 0), 3.7);
    for (int i = 1; i <= 400; ++i)
        trail.advance(on_circle(0.1 * i));
    EXPECT_NEAR((trail.rear() - on_circle(40 - 3.7)).norm(), 0, 0.02);
}

TEST(Trail, AStandingCarStands) {
    Trail trail;
    trail.start(Vector3d(0, 0, 1), Vector3d(-1, 0, 0), 8.6);
    const Vector3d before = trail.rear();
    for (int i = 0; i < 1000; ++i)
        trail.advance(Vector3d(0, 0, 1));
    EXPECT_EQ(trail.rear(), before);
}

TEST(Trail, ClimbsWithTheRoad) {
    Trail trail;
    trail.start(Vector3d(0, 0, 0), Vector3d(-1, 0, 0), 4);
    for (int i = 1; i <= 100; ++i)
        trail.advance(Vector3d(0.2 * i, 0, 0.02 * i));
    const Vector3d body = trail.front() - trail.rear();
    EXPECT_NEAR(std::atan2(body.z(), body.x()), std::atan(0.1), 1e-9);
}

/// Where a lane through a junction met the next one at 79 degrees, a bicycle at 3.1 m/s turned by
/// 10.9 degrees in one tick.
TEST(Trail, ATwoWheelerTurnsEvenlyWhereLanesMeetAtAnAngle) {
    constexpr double to_axle = 1.41;
    constexpr double driven = 0.155;
    const double corner = 79 * M_PI / 180;
    Trail trail;
    trail.start(Vector3d(0, 0, 0), Vector3d(-1, 0, 0), to_axle);
    double heading = 0;
    double sharpest = 0;
    for (int i = 1; i <= 60; ++i) {
        const double behind = driven * i - 4.5;  // the corner
        trail.advance(
            behind < 0 ? Vector3d(4.5 + behind, 0, 0)
                       : Vector3d(4.5 + behind * std::cos(corner), behind * std::sin(corner), 0));
        EXPECT_LE((trail.front() - trail.rear()).norm(), to_axle + 1e-9);
        const Vector3d body = trail.front() - trail.heads_from();
        const double now = std::atan2(body.y(), body.x());
        sharpest = std::max(sharpest, now - heading);
        heading = now;
    }
    EXPECT_NEAR(heading, corner, 1e-9);
    EXPECT_LT(sharpest, 7.5 * M_PI / 180);
}

}  // namespace
}  // namespace reprise::traffic
