// Off every road: back to it.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"
#include "tests/support/worlds.h"
#include "world/obstacle.h"

namespace reprise::test {
namespace {

void put(Drive& drive, double y, double yaw) {
    drive.place(0, 100, 0);
    drive.car.y = y;
    drive.car.yaw = yaw;
}

TEST(WayBack, LeadsToTheNearestLaneSlowly) {
    for (const double y : {-40.0, -15.0, -5.0, 15.0, 40.0})
        for (const double yaw : {-2.5, -1.5, 0.0, 1.5, 3.1}) {
            Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
            put(drive, y, yaw);
            double fastest = 0;
            while (drive.seconds() < 120) {
                drive.step();
                if (std::abs(drive.car.y) > 12)
                    fastest = std::max(fastest, drive.car.speed);
            }
            EXPECT_LT(std::abs(drive.car.y), 0.3) << "from " << y << " m beside it, yaw " << yaw;
            EXPECT_GT(drive.car.x, 150) << "from " << y << " m beside it, yaw " << yaw;
            EXPECT_LT(fastest, 2);
        }
}

/// Put across its way, one sped up while it turned, and weaved until it hit a lamp post at 8 m/s.
TEST(WayBack, GetsOntoItsLineSlowly) {
    for (const double y : {-6.0, -3.5, 3.5, 6.0}) {
        Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
        put(drive, y, y < 0 ? 1.5 : -1.5);
        double fastest = 0;
        while (drive.seconds() < 60) {
            drive.step();
            if (std::abs(drive.car.yaw) > 0.5)
                fastest = std::max(fastest, drive.car.speed);
        }
        EXPECT_LT(fastest, 3) << "[m/s] from " << y << " m beside it";
        EXPECT_GT(drive.car.x, 300);
    }
}

TEST(WayBack, AroundAWall) {
    world::Obstacle wall;
    wall.shape = world::Obstacle::Shape::box;
    wall.position << 104, -20, 0;
    wall.half = {4, 0.2, 2};
    const std::vector<world::Obstacle> obstacles{wall};
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)), 7, 0, obstacles);
    put(drive, -30, 1.2);
    int touched = 0;
    while (drive.seconds() < 180) {
        drive.step();
        for (double at = -0.9; at < drive.car.front(); at += 0.2) {
            const double x = drive.car.x + at * std::cos(drive.car.yaw);
            const double y = drive.car.y + at * std::sin(drive.car.yaw);
            touched += std::abs(x - 104) < 4 && std::abs(y + 20) < 0.2;
        }
    }
    EXPECT_EQ(touched, 0) << "ticks";
    EXPECT_LT(std::abs(drive.car.y), 0.3);
    EXPECT_GT(drive.car.x, 150);
}

TEST(WayBack, AroundWhoStandsThere) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    put(drive, -30, 1.5);
    world::WalkerState walker{};
    walker.mutate_id(100000001);
    walker.mutable_position() = world::Vec3(101, -22, 0);
    drive.walkers = {walker};
    while (drive.seconds() < 150) {
        drive.step();
        const double ahead = (101 - drive.car.x) * std::cos(drive.car.yaw) +
                             (-22 - drive.car.y) * std::sin(drive.car.yaw);
        const double aside = -(101 - drive.car.x) * std::sin(drive.car.yaw) +
                             (-22 - drive.car.y) * std::cos(drive.car.yaw);
        ASSERT_FALSE(ahead > -1 && ahead < drive.car.front() + 0.25 && std::abs(aside) < 1.1)
            << "at " << drive.seconds() << " s";
    }
    EXPECT_LT(std::abs(drive.car.y), 0.3) << "around it";
}

}  // namespace
}  // namespace reprise::test
