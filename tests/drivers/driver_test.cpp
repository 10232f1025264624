#include "drivers/driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"

namespace reprise::test {
namespace {

using world::LaneKind;
using world::SignalColor;
using world::Turn;

/// Two straight lanes with a signal and a junction of 10 m between them.
world::TownT signalled_junction() {
    world::TownT town;
    town.name = "signalled";
    town.lanes = {
        make_lane("before", Turtle(0, 0, 0).ahead(200)),
        make_lane("behind", Turtle(210, 0, 0).ahead(200)),
        make_lane(":j", Turtle(200, 0, 0).ahead(10), 13.89, LaneKind::internal),
    };
    town.junctions.resize(1);
    town.lanes[0].junction = 0;
    town.lanes[0].links = {make_link(1, 2, Turn::straight, false, 0)};
    town.signals.resize(1);
    return town;
}

world::WalkerState walker_at(double x, double y, double yaw, double speed) {
    return {world::Vec3(x, y, 0),
            static_cast<float>(yaw),
            static_cast<float>(speed),
            0,
            9,
            1,
            false,
            0,
            0};
}

TEST(Autopilot, KeepsAStraightLaneAndItsLimit) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 0);
    double fastest = 0;
    while (drive.seconds() < 60) {
        drive.step();
        EXPECT_LT(drive.off_centre(), 0.05);
        fastest = std::max(fastest, drive.car.speed);
        if (drive.seconds() > 20) {
            EXPECT_GT(drive.car.speed, 0.9 * 13.89) << "at " << drive.seconds() << " s";
        }
    }
    EXPECT_LT(fastest, 13.89);
}

TEST(Autopilot, ReturnsToItsLaneFromTheSide) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(400)));
    drive.place(0, 5, 10);
    drive.car.y = 1.2;
    double farthest_right = 0;
    while (drive.seconds() < 10) {
        drive.step();
        farthest_right = std::min(farthest_right, drive.car.y);
    }
    EXPECT_LT(drive.off_centre(), 0.05);
    EXPECT_GT(farthest_right, -0.15) << "overshoots";
}

class AutopilotInBends : public testing::TestWithParam<double> {};

TEST_P(AutopilotInBends, KeepsItsLane) {
    const double radius = GetParam();
    for (const double side : {1.0, -1.0}) {
        Drive drive(one_lane(Turtle(0, 0, 0)
                                 .ahead(120)
                                 .turn(side * quarter, radius)
                                 .ahead(30)
                                 .turn(-side * quarter, radius)
                                 .ahead(100)));
        drive.place(0, 5, 12);
        double sharpest = 0;
        while (drive.seconds() < 40) {
            drive.step();
            const double turn =
                std::tan(drive.car.steering_angle) / world::vehicle_models()[0].wheelbase;
            sharpest = std::max(sharpest, drive.car.speed * drive.car.speed * std::abs(turn));
            ASSERT_LT(drive.off_centre(), 0.3)
                << "radius " << radius * side << " m, at " << drive.seconds() << " s, "
                << drive.car.speed << " m/s";
        }
        EXPECT_LT(sharpest, 3.5) << "lateral acceleration";
    }
}

INSTANTIATE_TEST_SUITE_P(Radii, AutopilotInBends, testing::Values(6.0, 9.0, 15.0, 30.0, 80.0));

TEST(Autopilot, ObeysTheCapUntilItIsLifted) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 13);
    drive.autopilot->set_speed(6);
    while (drive.seconds() < 15)
        drive.step();
    EXPECT_NEAR(drive.car.speed, 6, 0.3);
    EXPECT_TRUE(drive.autopilot->is_under_way());
    drive.autopilot->set_speed(0);
    EXPECT_FALSE(drive.autopilot->is_under_way());
    drive.autopilot->free_speed();
    while (drive.seconds() < 35)
        drive.step();
    EXPECT_GT(drive.car.speed, 0.9 * 13.89);
}

/// 20 cm, where it likes 30: it waits for him, and he for it. Beside people it keeps what it likes.
TEST(Autopilot, CreepsPastWhoStandsAHandsBreadthTooNear) {
    constexpr double gap = 0.2;  // [m]
    const double half = world::vehicle_models()[0].width / 2;
    const auto driven = [&](bool is_walker) {
        Drive drive(one_lane(Turtle(0, 0, 0).ahead(300)));
        drive.place(0, 5, 0);
        if (is_walker)
            drive.walkers = {walker_at(40, half + gap + 0.25, 0, 0)};
        else
            drive.cars = {car_at(1'000'000, 40, 2 * half + gap, std::acos(-1.0), 0)};
        double fastest_beside = 0;
        while (drive.seconds() < 40) {
            drive.step();
            if (drive.car.x + drive.car.front() > 37 && drive.car.x < 40)
                fastest_beside = std::max(fastest_beside, drive.car.speed);
        }
        EXPECT_LT(fastest_beside, 2);
        return drive.car.x;
    };
    EXPECT_GT(driven(false), 100);
    EXPECT_LT(driven(true), 40);
}

/// Tighter than it likes to turn: it comes out near the line. Who waits there, red for as long as
/// we have green, is passed by two hands' breadths, where it likes three.
TEST(Autopilot, CreepsPastWhoWaitsBesideATightTurn) {
    const world::VehicleModel& sedan = world::vehicle_models()[0];
    const double front = sedan.length - sedan.rear_overhang;  // [m] ahead of its origin
    constexpr double exit_x = 54.2, line_y = -6.2;
    // Of that lane's middle left of ours, until it is past or 40 s are over; its nearest corner.
    const auto drive_past = [&](double aside) {
        Drive drive(one_lane(Turtle(0, 0, 0).ahead(50).turn(-quarter, 4.2).ahead(60)));
        drive.place(0, 5, 0);
        drive.cars = {car_at(1'000'000, exit_x + aside, line_y - front, quarter, 0)};
        double gap = world::infinity;
        while (drive.seconds() < 40 && drive.car.y > -20) {
            drive.step();
            const double c = std::cos(drive.car.yaw), n = std::sin(drive.car.yaw);
            for (const double along : {-sedan.rear_overhang, front})
                for (const double left : {-sedan.width / 2, sedan.width / 2}) {
                    const double x = drive.car.x + along * c - left * n;
                    const double y = drive.car.y + along * n + left * c;
                    if (y < line_y && y > line_y - sedan.length)
                        gap = std::min(gap, exit_x + aside - sedan.width / 2 - x);
                }
        }
        return std::pair(drive.car.y < -20, gap);
    };
    EXPECT_FALSE(drive_past(2.8).first);
    for (const double aside : {2.92, 2.96, 3.1, 3.5}) {
        const auto [is_past, gap] = drive_past(aside);
        EXPECT_TRUE(is_past) << aside;
        EXPECT_GT(gap, 0.18) << aside;
    }
}

TEST(Autopilot, StopsWhereTheRoadEndsAndStays) {
    Drive drive(straight_road(200));
    drive.place(1, 5, 10);
    drive.step();
    EXPECT_TRUE(drive.autopilot->is_under_way());
    while (drive.seconds() < 40)
        drive.step();
    EXPECT_FALSE(drive.autopilot->is_under_way());
    const double left = 200 - drive.car.x - drive.car.front();
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_GT(left, 0.5);
    EXPECT_LT(left, 2);
}

TEST(Autopilot, StopsBeforeRedAndGoesOnGreen) {
    Drive drive(signalled_junction());
    drive.place(0, 5, 12);
    drive.signals = {SignalColor::red};
    double hardest = 0;
    while (drive.seconds() < 40) {
        drive.step();
        hardest = std::max(hardest, drive.control.brake() * 9);
        ASSERT_LT(drive.car.x + drive.car.front(), 200);
    }
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_NEAR(drive.car.x + drive.car.front(), 199, 0.5);
    EXPECT_LT(hardest, 5);  // standing on the brake counts as 4.5
    drive.signals = {SignalColor::green};
    while (drive.seconds() < 60)
        drive.step();
    EXPECT_GT(drive.car.x, 220);
}

TEST(Autopilot, StopsAtYellowOnlyWhereThatIsComfortable) {
    for (const double distance : {15.0, 60.0}) {
        Drive drive(signalled_junction());
        drive.place(0, 200 - distance - drive.car.front(), 13);
        double most_brake = 0;
        while (drive.seconds() < 10) {
            drive.signals = {drive.seconds() < 3 ? SignalColor::yellow : SignalColor::red};
            drive.step();
            most_brake = std::max(most_brake, drive.control.brake());
        }
        if (distance < 20) {
            EXPECT_GT(drive.car.x, 210);
            EXPECT_LT(most_brake, 0.1);
        } else {
            EXPECT_LT(drive.car.x + drive.car.front(), 200);
            EXPECT_LT(most_brake * 9, 5);
        }
    }
}

TEST(Autopilot, KeepsItsDistanceFromASlowLeader) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 13);
    double leader = 80;
    while (drive.seconds() < 40) {
        drive.cars = {car_at(1'000'000, leader, 0, 0, 5)};
        drive.step();
        leader += 5 * 0.05;
        const double gap = leader - 1.0 - drive.car.x - drive.car.front();
        ASSERT_GT(gap, 4) << "at " << drive.seconds() << " s";
    }
    const double gap = leader - 1.0 - drive.car.x - drive.car.front();
    EXPECT_NEAR(drive.car.speed, 5, 0.3);
    EXPECT_LT(gap, 15);
}

TEST(Autopilot, StopsBehindAStandingCarAndGoesOnAfterIt) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    double leader = 200;
    while (drive.seconds() < 40) {
        drive.cars = {car_at(1'000'000, leader, 0)};
        drive.step();
    }
    const double gap = leader - 1.0 - drive.car.x - drive.car.front();
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_GT(gap, 1.5);
    EXPECT_LT(gap, 5);
    while (drive.seconds() < 60) {
        leader += 8 * 0.05;
        drive.cars = {car_at(1'000'000, leader, 0, 0, 8)};
        drive.step();
    }
    EXPECT_GT(drive.car.speed, 6);
}

TEST(Autopilot, DoesNotPanicWhenSomebodyFasterCutsIn) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 10);
    drive.autopilot->set_speed(10);
    double x = 0;
    double y = 3.5;
    double hardest = 0;
    while (drive.seconds() < 15) {
        // Beside us at first, then four metres ahead, from the left lane into ours.
        x = drive.car.x + drive.car.front() + 5 + std::max(drive.seconds() - 3, 0.0) * 1.5;
        y = std::clamp(3.5 - (drive.seconds() - 3) * 1.2, 0.0, 3.5);
        drive.cars = {car_at(1'000'000, x, y, 0, 11.5)};
        drive.step();
        hardest = std::max(hardest, drive.control.brake() * 9);
    }
    EXPECT_LT(hardest, 4);
    EXPECT_GT(hardest, 0.1) << "does not notice it at all";
}

TEST(Autopilot, PassesCarsThatStandBesideItsLane) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    drive.cars = {car_at(1'000'000, 150, -2.6), car_at(1'000'001, 180, 3.5, std::numbers::pi)};
    while (drive.seconds() < 25) {
        drive.step();
        if (drive.seconds() > 1) {
            EXPECT_GT(drive.car.speed, 0.9 * 13.89);
        }
    }
}

class AutopilotAndWalkers : public testing::TestWithParam<double> {};

TEST_P(AutopilotAndWalkers, StopsForOneWhoStepsOntoTheRoad) {
    const double speed = GetParam();
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    double y = -1.5 - 2 * speed;
    double closest = 100;
    while (drive.seconds() < 30) {
        // Starts when the car is 35 m away, is at its path two seconds later - when the car would
        // be a metre or two past - and stops in the middle of the lane for a while.
        const bool walks = drive.car.x + drive.car.front() > 165 && (y < 0 || drive.seconds() > 22);
        y += walks ? speed * 0.05 : 0;
        drive.walkers = {walker_at(200, y, quarter, walks ? speed : 0)};
        drive.step();
        const double gap = 200 - 0.25 - drive.car.x - drive.car.front();
        if (std::abs(y) < 1.2)
            closest = std::min(closest, gap);
    }
    EXPECT_GT(closest, 0.5);
    EXPECT_GT(drive.car.x, 200) << "goes on when the way is free";
}

INSTANTIATE_TEST_SUITE_P(Speeds, AutopilotAndWalkers, testing::Values(1.3, 2.0, 3.5));

TEST(Autopilot, IgnoresWalkersOnTheSidewalk) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    double x = 150;
    while (drive.seconds() < 20) {
        x += 1.3 * 0.05;
        drive.walkers = {walker_at(x, -3.5, 0, 1.3)};
        drive.step();
        if (drive.seconds() > 1) {
            EXPECT_GT(drive.car.speed, 0.9 * 13.89);
        }
    }
}

TEST(Autopilot, DoesNotBlockAJunctionWithoutAWayOut) {
    Drive drive(signalled_junction());
    drive.place(0, 100, 10);
    drive.signals = {SignalColor::green};
    drive.cars = {car_at(1'000'000, 215, 0)};  // stands just behind the junction
    while (drive.seconds() < 25)
        drive.step();
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_LT(drive.car.x + drive.car.front(), 200);
}

}  // namespace
}  // namespace reprise::test
