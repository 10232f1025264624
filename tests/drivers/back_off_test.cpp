// Who is held by what it touches goes back, and tries again.
#include "drivers/back_off.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"
#include "tests/support/worlds.h"
#include "world/geometry2d.h"
#include "world/obstacle.h"
#include "world/units.h"

namespace reprise::test {
namespace {

/// A wall across the road that the driver does not see until it is torn down.
class Wall {
  public:
    explicit Wall(double x) : x_(x) {}

    void step(Drive& drive, std::vector<std::string>& news) {
        drive.step();
        if (const drivers::DriverNews* said = drive.autopilot->news())
            news.push_back(said->text);
        drive.measurements.resize(1);
        drive.measurements[0].mutate_actor(1);
        const double beyond = drive.car.x + drive.car.front() - x_;
        if (stands_ && beyond >= 0) {
            impulse_ += 200;
            drive.car.x -= beyond;
            drive.car.speed = std::min(drive.car.speed, 0.0);
        }
        drive.measurements[0].mutate_impulse_static(impulse_);
    }

    void tear_down() { stands_ = false; }

  private:
    double x_;
    double impulse_ = 0;
    bool stands_ = true;
};

TEST(BackOff, AfterTwoSecondsOfPushing) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 20, 5);
    Wall wall(50);
    std::vector<std::string> news;
    double touched = 0;
    while (news.empty() && drive.seconds() < 30) {
        wall.step(drive, news);
        if (touched == 0 && drive.measurements[0].impulse_static() > 0)
            touched = drive.seconds();
    }
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0], "backs off 3.0 m, after pushing against something for 2 s");
    EXPECT_NEAR(drive.seconds() - touched, 2, 0.5);
    wall.tear_down();
    const double from = drive.car.x;
    double farthest_back = from;
    while (drive.seconds() < 30) {
        wall.step(drive, news);
        farthest_back = std::min(farthest_back, drive.car.x);
    }
    EXPECT_NEAR(from - farthest_back, 3, 0.5);
    EXPECT_GT(drive.car.x, 80) << "drives on";
    EXPECT_EQ(news.size(), 1u) << "once";
}

TEST(BackOff, NotIntoWhoStandsBehind) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 20, 5);
    world::CarState behind{};
    behind.mutate_id(50);
    behind.mutate_lane(world::none);
    Wall wall(50);
    std::vector<std::string> news;
    double least = 1e9;
    while (drive.seconds() < 40) {
        wall.step(drive, news);
        if (!news.empty() && drive.cars.empty()) {
            behind.mutable_position() = world::Vec3(drive.car.x - 6.5, 0, 0);
            drive.cars = {behind};
        }
        if (!drive.cars.empty())
            least = std::min(least, drive.car.x - drive.cars[0].position().x());
    }
    const world::VehicleModel& model = world::vehicle_models()[0];
    EXPECT_GT(least, model.length) << "touches who stands behind it";
}

/// Who makes room again and again in a junction would come over the lane of the other one, and off
/// the road, from where nothing leads back.
TEST(BackOff, NotOffItsLanes) {
    constexpr double tail_at = 2;  // [m] before the lane's start
    const world::VehicleModel& model = world::vehicle_models()[0];
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, tail_at + model.rear_overhang, 0);
    Wall wall(drive.car.x + drive.car.front() + 0.1);
    std::vector<std::string> news;
    double least = 1e9;
    while (drive.seconds() < 60) {
        wall.step(drive, news);
        least = std::min(least, drive.car.x - model.rear_overhang);
    }
    EXPECT_FALSE(news.empty());
    EXPECT_LT(least, 1) << "as far as it can";
    EXPECT_GT(least, -0.3);
}

TEST(BackOff, ItsNoseDoesNotSwingIntoWhoStandsBesideIt) {
    // It stands 0.8 m left of its path, and would turn its tail to the path, its nose away from it.
    constexpr double aside = 0.8;
    const world::VehicleModel& model = world::vehicle_models()[0];
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 45, 0);
    drive.car.y = aside;
    Wall wall(45 + drive.car.front() + 0.1);
    world::CarState beside{};
    beside.mutate_id(50);
    beside.mutate_lane(world::none);
    const double right_side = aside + model.width / 2 + 0.25;
    beside.mutable_position() = world::Vec3(46, right_side + model.width / 2, 0);
    drive.cars = {beside};
    std::vector<std::string> news;
    while (drive.seconds() < 12) {
        wall.step(drive, news);
        const double left_corner = drive.car.y + drive.car.front() * std::sin(drive.car.yaw) +
                                   model.width / 2 * std::cos(drive.car.yaw);
        ASSERT_LT(left_corner, right_side - 0.1) << "at " << drive.seconds() << " s";
    }
    EXPECT_FALSE(news.empty());
}

/// A corner without a curve, and a house behind it: at full lock it does not come round in one go.
/// Back along its own arc it came to where it was before, for ever; and turned on, but driving to
/// its path again, as well.
class BackOffInACorner : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(RoomBehindIt, BackOffInACorner, testing::Values(1.95, 2.05, 2.15));

TEST_P(BackOffInACorner, TurnsOnBackwardsBeforeAWall) {
    const double wall = 100 + GetParam();  // [m] east
    world::Obstacle house;
    house.shape = world::Obstacle::Shape::box;
    house.position << wall + 1.5, 0, 0;
    house.half = {1.5, 12, 2};
    const std::vector<world::Obstacle> obstacles{house};
    Drive drive(
        one_lane(Turtle(0, 0, 0).ahead(100).turn(quarter, 0.2).ahead(100)), 7, 0, obstacles);
    drive.place(0, 50, 8);
    std::vector<std::string> news;
    double deepest = -1e9;
    while (drive.seconds() < 60 && drive.car.y < 40) {
        drive.step();
        if (const drivers::DriverNews* said = drive.autopilot->news())
            news.push_back(said->text);
        const double bow = drive.car.x + drive.car.front() * std::cos(drive.car.yaw);
        const double half = world::vehicle_models()[0].width / 2;
        deepest = std::max(deepest, bow + half * std::abs(std::sin(drive.car.yaw)));
    }
    EXPECT_GT(drive.car.y, 39) << "has come round";
    EXPECT_LT(deepest, wall) << "[m] of its front corner: the house begins there";
    EXPECT_FALSE(news.empty()) << "it is no proof otherwise";
}

/// Nose to flank, as two stand in a junction; whether it may overtake or not.
class BackOffBeforeOneAcross : public testing::TestWithParam<bool> {};

/// Of SUMO, in a junction, with its flank before who comes along y = 0 to x = 60.
world::CarState car_across() {
    world::CarState across{};
    across.mutate_id(50);
    across.mutate_lane(world::none);
    across.mutate_yaw(static_cast<float>(std::acos(0.0)));
    across.mutate_lamps(world::lamp_brake);
    across.mutable_position() = world::Vec3(60, -2, 0);
    return across;
}

INSTANTIATE_TEST_SUITE_P(MayOvertake, BackOffBeforeOneAcross, testing::Bool());

TEST_P(BackOffBeforeOneAcross, LetsItGo) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 20, 5);
    drive.autopilot->may_overtake(GetParam());
    drive.cars = {car_across()};
    std::vector<std::string> news;
    double farthest = 0;
    double back_at = 0;
    while (drive.seconds() < 60 && news.empty()) {
        drive.step();
        farthest = std::max(farthest, drive.car.x);
        if (const drivers::DriverNews* said = drive.autopilot->news())
            news.push_back(said->text);
    }
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0], "backs off 2.5 m, to let go who waits for it");
    // The other one takes its time to start, and has gone 4 m when we look.
    const double begun = drive.seconds();
    double least = farthest;
    for (; drive.seconds() < begun + 9; back_at = drive.car.x) {
        drive.step();
        least = std::min(least, drive.car.x);
    }
    EXPECT_NEAR(farthest - least, 2.5, 0.4);
    EXPECT_NEAR(back_at, least, 0.3) << "waits for the other one";
    drive.cars.clear();
    while (drive.seconds() < begun + 30)
        drive.step();
    EXPECT_GT(drive.car.x, 80) << "drives on";
}

/// Both may be built-in drivers, and both be held by the other one.
TEST(BackOff, OfTwoTheOneWhoCameLaterMakesRoom) {
    const auto goes_back_after = [](std::uint32_t other, std::uint16_t lamps) {
        Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
        drive.place(0, 20, 5);
        drive.others = {vehicle_at(other, 60, -2, std::acos(0.0), 0)};
        drive.others[0].mutate_lamps(lamps);
        double stood_at = 0;
        while (drive.seconds() < 60 && drive.autopilot->news() == nullptr) {
            drive.step();
            if (stood_at == 0 && drive.seconds() > 1 && drive.car.speed < 0.1)
                stood_at = drive.seconds();
        }
        return drive.seconds() - stood_at;
    };
    EXPECT_NEAR(goes_back_after(0, world::lamp_brake), 10, 1);
    EXPECT_NEAR(goes_back_after(2, world::lamp_brake), 20, 1);
    EXPECT_GT(goes_back_after(2, 0), 40) << "nobody is at its wheel: it waits for nobody";
}

/// What the other one gives by going back is of use only to who comes nearer than in a queue.
TEST(BackOff, ABusNosesUpToWhoStandsAcrossItsTurn) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(60).turn(quarter, 14).ahead(200)),
                7,
                *world::find_vehicle_model("bus"));
    drive.place(0, 20, 5);
    world::CarState across{};
    across.mutate_id(50);
    across.mutate_lane(world::none);
    across.mutate_yaw(static_cast<float>(-quarter));
    across.mutate_lamps(world::lamp_brake);
    across.mutable_position() = world::Vec3(58, 2, 0);
    drive.cars = {across};
    const double side = 58 - world::vehicle_models()[0].width / 2;
    std::vector<double> gaps;  // each second
    while (drive.seconds() < 30 && drive.autopilot->news() == nullptr) {
        drive.step();
        if (drive.tick % 20 == 0)
            gaps.push_back(side - drive.car.x - drive.car.front());
    }
    EXPECT_NEAR(gaps.back(), 0.9, 0.3);
    EXPECT_GE(std::ranges::count_if(gaps, [](double gap) { return gap > 2.4 && gap < 3; }), 3)
        << "it stood before as in a queue";
}

/// For as long as the other one is on its way past, but not for ever.
TEST(BackOff, WaitsWhileTheOtherOneGoes) {
    const auto waits = [](double speed) {
        Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
        drive.place(0, 20, 5);
        drive.cars = {car_across()};
        while (drive.seconds() < 60 && drive.autopilot->news() == nullptr)
            drive.step();
        const double begun = drive.seconds();
        drive.cars[0].mutate_speed(static_cast<float>(speed));
        double least = drive.car.x;
        while (drive.seconds() < begun + 60 && drive.car.x < least + 0.3) {
            drive.step();
            least = std::min(least, drive.car.x);
            drive.cars[0].mutable_position().mutate_y(drive.cars[0].position().y() + speed * 0.05);
        }
        return drive.seconds() - begun;
    };
    const double standing = waits(0);
    EXPECT_LT(standing, 14);
    EXPECT_GT(waits(0.25), standing + 8);
    EXPECT_LT(waits(0.15), 40) << "the longest";
}

/// Beside its path and turned away from that, as after a step back: the path is free, but the way
/// back to it leads past a car.
TEST(BackOff, FromWhatItsWheelsLeadInto) {
    for (const double aside : {1.5, 2.0, 2.5, 3.0}) {
        Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
        drive.place(0, 40, 4);
        drive.car.y = aside;
        drive.car.yaw = 0.35;
        world::CarState beside{};
        beside.mutate_id(50);
        beside.mutate_lane(world::none);
        beside.mutable_position() = world::Vec3(40 + drive.car.front() + 3.5, aside + 1.6, 0);
        drive.cars = {beside};
        const world::VehicleModel& model = world::vehicle_models()[0];
        const double rear = beside.position().x() - model.rear_overhang;
        bool goes_back = false;
        while (drive.seconds() < 12 && !goes_back) {
            drive.step();
            goes_back = drive.autopilot->news() != nullptr;
            const Eigen::Vector2d ahead(std::cos(drive.car.yaw), std::sin(drive.car.yaw));
            const double left = model.width / 2;
            const double front = drive.car.x + drive.car.front() * ahead.x() - left * ahead.y();
            const double corner = drive.car.y + drive.car.front() * ahead.y() + left * ahead.x();
            ASSERT_FALSE(front > rear && front < rear + model.length &&
                         corner > beside.position().y() - left)
                << "from " << aside << " m beside, at " << drive.seconds() << " s, "
                << drive.car.speed << " m/s";
        }
        EXPECT_TRUE(goes_back || drive.car.x > 80) << "from " << aside << " m beside";
    }
}

/// Who stands askew of his way may begin a turn that his wheels cannot follow.
TEST(BackOff, FromAPoleThatItsWheelsLeadInto) {
    const world::VehicleModel& model = world::vehicle_models()[0];
    const auto begin = [](Drive& drive) {
        drive.place(0, 40, 0);
        drive.car.yaw = 1;
    };
    const auto road = [] {
        world::TownT town = one_lane(Turtle(0, 0, 0).ahead(600));
        town.lanes.push_back(make_lane("beside", Turtle(0, -3.5, 0).ahead(600)));
        return town;
    };
    const auto left_corner = [&](const Drive& drive, double in) {
        const Eigen::Vector2d ahead(std::cos(drive.car.yaw), std::sin(drive.car.yaw));
        return Eigen::Vector2d(Eigen::Vector2d(drive.car.x, drive.car.y) +
                               (drive.car.front() - in) * ahead +
                               (model.width / 2 - in) * world::turned_left(ahead));
    };
    Drive alone(road());
    begin(alone);
    while (alone.seconds() < 10 && alone.car.odometer < 1.5)
        alone.step();
    ASSERT_GT(std::abs(alone.car.steering_angle), 0.6 * model.max_steering_angle);
    world::Obstacle pole;
    pole.shape = world::Obstacle::Shape::cylinder;
    pole.position << left_corner(alone, 0.2), 0;
    pole.half = {0.1, 0.1, 2};
    pole.radius = 0.1;
    const std::vector<world::Obstacle> obstacles{pole};
    Drive drive(road(), 7, 0, obstacles);
    begin(drive);
    int touched = 0;
    while (drive.seconds() < 60) {
        drive.step();
        const Eigen::Vector2d to =
            pole.position.head<2>() - Eigen::Vector2d(drive.car.x, drive.car.y);
        const Eigen::Vector2d ahead(std::cos(drive.car.yaw), std::sin(drive.car.yaw));
        touched += to.dot(ahead) < drive.car.front() + 0.1 && to.dot(ahead) > 0 &&
                   std::abs(world::cross(ahead, to)) < model.width / 2 + 0.1;
    }
    EXPECT_EQ(touched, 0) << "ticks";
    EXPECT_GT(drive.car.x, 60) << "gets on";
}

/// One had come to stand on the pavement, along its lane, in which a car waited for it with its
/// front behind the other's: each in the other's way, for ever.
TEST(BackOff, NobodyNeedsToWhoComesBackAheadOfWhoWaitsBesideIt) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 40, 0);
    drive.car.y = -3.7;
    world::CarState beside{};
    beside.mutate_id(50);
    beside.mutate_lane(0);
    beside.mutate_lane_s(42);  // its front; ours is at 43.6
    beside.mutable_position() = world::Vec3(42, 0, 0);
    drive.cars = {beside};
    const world::VehicleModel& model = world::vehicle_models()[0];
    while (drive.seconds() < 30) {
        drive.step();
        const double rear_corner = drive.car.y + model.width / 2 * std::cos(drive.car.yaw) -
                                   model.rear_overhang * std::sin(drive.car.yaw);
        if (drive.car.x - model.rear_overhang < 42) {
            ASSERT_LT(rear_corner, -model.width / 2) << "at " << drive.seconds() << " s";
        }
    }
    EXPECT_GT(drive.car.x, 80) << "gets on";
    EXPECT_NEAR(drive.car.y, 0, 0.3);
}

TEST(BackOff, NotWhoWasToldASpeed) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 20, 5);
    drive.autopilot->hold_speed(5, 0, world::Shape::linear);
    Wall wall(50);
    std::vector<std::string> news;
    while (drive.seconds() < 20)
        wall.step(drive, news);
    EXPECT_TRUE(news.empty());
}

TEST(BackOff, AfterSixSecondsAtFullLockWithoutGettingOn) {
    const Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    const drivers::Ego ego = drivers::ego_of(vehicle_at(1, 0, 0, 0, 0.5));
    const auto seconds_until = [&](double steer, double speed_along) {
        drivers::BackOff back_off(drive.map, 0.05);
        for (int tick = 1; tick <= 400; ++tick)
            if (back_off.notice_circling(ego, 100 + 0.05 * tick * speed_along, steer))
                return 0.05 * tick;
        return world::infinity;
    };
    EXPECT_NEAR(seconds_until(1, 0), 6, 0.11);
    EXPECT_NEAR(seconds_until(-1, 0.05), 6, 0.11);
    EXPECT_EQ(seconds_until(1, 0.5), world::infinity) << "a tight bend";
    EXPECT_EQ(seconds_until(0.8, 0), world::infinity);
}

}  // namespace
}  // namespace reprise::test
