#include "drivers/turn_around.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"
#include "world/frames.h"

namespace reprise::test {
namespace {

using world::Turn;

constexpr double road_end = 120;  // [m]

/// A street of two lanes along the x axis that ends at x = 120: east_1 (index 1) turns around into
/// west_1.
world::TownT dead_end(double lane_width) {
    world::TownT town = straight_road(road_end);
    std::uint32_t east = 0;
    std::uint32_t west = 0;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        world::LaneT& lane = town.lanes[i];
        if (lane.kind != world::LaneKind::driving)
            continue;
        const bool eastbound = lane.name == "east_1";
        (eastbound ? east : west) = i;
        lane.width = lane_width;
        for (world::Vec3& point : lane.centre)
            point.mutate_y((eastbound ? -0.5 : 0.5) * lane_width);
    }
    town.lanes.push_back(
        make_lane(":end",
                  Turtle(road_end, -lane_width / 2, 0).turn(std::numbers::pi, lane_width / 2),
                  5.5,
                  world::LaneKind::internal));
    const auto inside = static_cast<std::uint32_t>(town.lanes.size() - 1);
    town.lanes[east].links = {make_link(west, inside, Turn::around)};
    town.lanes[inside].links = {make_link(west, world::none, Turn::around)};
    town.junctions.resize(1);
    town.lanes[east].junction = 0;
    return town;
}

/// [m] of the car's corner that is farthest from the middle of the street, and farthest east.
struct Reach {
    double side = 0;
    double ahead = 0;
};

Reach reach_of(const KinematicCar& car) {
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    Reach reach;
    for (const double x : {-model.rear_overhang, model.length - model.rear_overhang})
        for (const double y : {-model.width / 2, model.width / 2}) {
            reach.side = std::max(reach.side,
                                  std::abs(car.y + x * std::sin(car.yaw) + y * std::cos(car.yaw)));
            reach.ahead =
                std::max(reach.ahead, car.x + x * std::cos(car.yaw) - y * std::sin(car.yaw));
        }
    return reach;
}

class TurnAroundOnStreets : public testing::TestWithParam<std::tuple<double, const char*>> {};

TEST_P(TurnAroundOnStreets, KeepsAllCornersBetweenTheKerbs) {
    const auto [lane_width, name] = GetParam();
    const auto model = world::find_vehicle_model(name);
    ASSERT_TRUE(model);
    Drive drive(dead_end(lane_width), 7, *model);
    drive.place(1, 60, 8);
    Reach farthest;
    while (drive.car.x > 50 && drive.seconds() < 90) {
        drive.step();
        const Reach reach = reach_of(drive.car);
        farthest.side = std::max(farthest.side, reach.side);
        farthest.ahead = std::max(farthest.ahead, reach.ahead);
    }
    EXPECT_LE(drive.car.x, 50) << "it drives back";
    EXPECT_NEAR(drive.car.y, lane_width / 2, 0.2) << "on its side";
    EXPECT_LT(farthest.side, lane_width + 0.1) << "[m] a kerb is at " << lane_width;
    EXPECT_LT(farthest.ahead, road_end + 2.5);
}

INSTANTIATE_TEST_SUITE_P(Widths,
                         TurnAroundOnStreets,
                         testing::Combine(testing::Values(3.0, 3.2, 3.5, 4.5),
                                          testing::Values("sedan", "suv", "city_car")));

/// In a queue somebody stands close behind, in the lane that we come from: who ends his turn in
/// that lane stands before his bumper.
TEST_P(TurnAroundOnStreets, EndsInTheNewLane) {
    const auto [lane_width, name] = GetParam();
    Drive drive(dead_end(lane_width), 7, *world::find_vehicle_model(name));
    drive.place(1, 60, 8);
    const auto points_back = [&] {
        return std::abs(world::wrap_angle(drive.car.yaw - std::numbers::pi)) < 0.35;
    };
    while (!points_back() && drive.seconds() < 90)
        drive.step();
    ASSERT_TRUE(points_back());
    EXPECT_GT(drive.car.y, 0) << "[m] left of the middle of the street";
}

/// Who was held up in the midst of his turn, went back, and looks for his way anew finds it there.
TEST_P(TurnAroundOnStreets, GoesOnWithATurnThatHasBegun) {
    const auto [lane_width, name] = GetParam();
    Drive drive(dead_end(lane_width), 7, *world::find_vehicle_model(name));
    drive.place(static_cast<std::uint32_t>(drive.town.lanes.size() - 1), 0.3, 0);
    drive.car.yaw = 0.6;
    double farthest = 0;
    while (drive.car.x > 90 && drive.seconds() < 90) {
        drive.step();
        farthest = std::max(farthest, reach_of(drive.car).side);
    }
    EXPECT_LE(drive.car.x, 90) << "it drives back";
    EXPECT_LT(farthest, lane_width + 0.5) << "bumpers may reach over a kerb";
}

/// Who has stopped for somebody anywhere before the place where turning begins goes on from there.
TEST(TurnAround, BeginsWhereverTheCarHasStoppedBeforeIt) {
    const std::uint16_t model = *world::find_vehicle_model("city_car");
    const double front =
        world::vehicle_models()[model].length - world::vehicle_models()[model].rear_overhang;
    for (double short_of = -0.5; short_of < 3; short_of += 0.1) {
        Drive drive(dead_end(3.2), 7, model);
        drive.place(1, road_end - drivers::TurnAround::before_end - short_of - front, 0);
        while (drive.car.x > 90 && drive.seconds() < 90)
            drive.step();
        EXPECT_LE(drive.car.x, 90) << short_of << " m before it";
    }
}

class TurnAroundOnVanStreets : public testing::TestWithParam<double> {};

/// A van is 5.3 m long: its bumpers reach over the kerbs of two narrow lanes, by less than signs
/// stand beside them.
TEST_P(TurnAroundOnVanStreets, ReachesOverKerbsByLittle) {
    const double lane_width = GetParam();
    Drive drive(dead_end(lane_width), 7, *world::find_vehicle_model("van"));
    drive.place(1, 60, 8);
    double farthest = 0;
    while (drive.car.x > 50 && drive.seconds() < 120) {
        drive.step();
        farthest = std::max(farthest, reach_of(drive.car).side);
    }
    EXPECT_LE(drive.car.x, 50) << "it drives back";
    EXPECT_LT(farthest, lane_width + 0.55);
}

INSTANTIATE_TEST_SUITE_P(Widths, TurnAroundOnVanStreets, testing::Values(2.75, 3.0, 3.25));

class TurnAroundOnSlopes : public testing::TestWithParam<double> {};

TEST_P(TurnAroundOnSlopes, ComesBackUphillAndDownhill) {
    world::TownT town = dead_end(3.2);
    for (world::LaneT& lane : town.lanes)
        for (world::Vec3& point : lane.centre)
            point.mutate_z(GetParam() * point.x());
    Drive drive(town);
    drive.car.slope = GetParam();
    drive.place(1, 60, 8);
    Reach farthest;
    while (drive.car.x > 50 && drive.seconds() < 60) {
        drive.step();
        farthest.side = std::max(farthest.side, reach_of(drive.car).side);
    }
    EXPECT_LE(drive.car.x, 50) << "it drives back";
    EXPECT_LT(farthest.side, 3.2 + 0.1);
}

INSTANTIATE_TEST_SUITE_P(Slopes, TurnAroundOnSlopes, testing::Values(-0.15, -0.08, 0.08, 0.15));

TEST(TurnAround, IsForStreetsThatAreTooNarrowToDriveAroundIn) {
    const auto street = [](double lane_width, const char* name) {
        const world::TownT town = dead_end(lane_width);
        const world::LaneT& lane = town.lanes[1];
        return drivers::TurnAround::street_of(
            town, 1, lane.links[0], world::vehicle_models()[*world::find_vehicle_model(name)]);
    };
    ASSERT_TRUE(street(3.5, "sedan"));
    EXPECT_NEAR(street(3.5, "sedan")->left, 3.5 + 1.75, 1e-9);
    EXPECT_NEAR(street(3.5, "sedan")->right, 1.75, 1e-9);
    EXPECT_FALSE(street(12, "sedan")) << "one sweep is enough";
    EXPECT_FALSE(street(3.5, "bus")) << "never";
}

/// It has driven back so many ticks, and somebody stands so far behind its rear axle [m].
Drive with_somebody_behind(int ticks_back, double distance) {
    Drive drive(dead_end(3.5));
    drive.place(1, 60, 8);
    while (!drive.control.reverse() && drive.seconds() < 60)
        drive.step();
    for (int i = 0; i < ticks_back; ++i)
        drive.step();
    EXPECT_TRUE(drive.control.reverse());
    const double x = drive.car.x - distance * std::cos(drive.car.yaw);
    const double y = drive.car.y - distance * std::sin(drive.car.yaw);
    drive.walkers = {world::WalkerState(world::Vec3(x, y, 0), 0, 0, 0, 9, 1, false, 0, 0)};
    return drive;
}

/// [m] from a place to the car's body.
double distance_to(const KinematicCar& car, const world::Vec3& place) {
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const double dx = place.x() - car.x;
    const double dy = place.y() - car.y;
    const double along = dx * std::cos(car.yaw) + dy * std::sin(car.yaw);
    const double across = dy * std::cos(car.yaw) - dx * std::sin(car.yaw);
    const double front = model.length - model.rear_overhang;
    return std::hypot(std::max({-model.rear_overhang - along, along - front, 0.0}),
                      std::max(std::abs(across) - model.width / 2, 0.0));
}

/// Two who wait for each other there would wait for ever.
TEST(TurnAround, ComesAroundBeforeSomebodyWhoStaysBehindIt) {
    Drive drive = with_somebody_behind(20, 2.8);
    double nearest = 10;
    while (drive.car.x > 50 && drive.seconds() < 240) {
        drive.step();
        nearest = std::min(nearest, distance_to(drive.car, drive.walkers.front().position()));
    }
    EXPECT_LE(drive.car.x, 50);
    EXPECT_GT(nearest, 0.4) << "[m]";
}

/// [m] between two bodies seen from above, by the corners of either: they are never nearer
/// elsewhere.
double distance_between(const KinematicCar& one, const KinematicCar& other) {
    double least = 1e9;
    const auto corners_of = [&](const KinematicCar& car, const KinematicCar& from) {
        const world::VehicleModel& model = world::vehicle_models()[car.model];
        for (const double x : {-model.rear_overhang, model.length - model.rear_overhang})
            for (const double y : {-model.width / 2, model.width / 2})
                least = std::min(least,
                                 distance_to(from,
                                             {car.x + x * std::cos(car.yaw) - y * std::sin(car.yaw),
                                              car.y + x * std::sin(car.yaw) + y * std::cos(car.yaw),
                                              0}));
    };
    corners_of(one, other);
    corners_of(other, one);
    return least;
}

class TurnAroundBeforeQueue : public testing::TestWithParam<double> {};

/// The first of those behind it drives up to where it turns, and waits for it there.
TEST_P(TurnAroundBeforeQueue, PassesWhoWaitsBehindIt) {
    Drive drive(dead_end(3.2));
    drive.place(1, 60, 8);
    while (!drive.control.reverse() && drive.seconds() < 60)
        drive.step();
    KinematicCar first;
    first.x = road_end - GetParam();
    first.y = -1.6;
    drive.cars = {car_at(1'000'000, first.x, first.y)};
    double nearest = 10;
    while (drive.car.x > 50 && drive.seconds() < 120) {
        drive.step();
        nearest = std::min(nearest, distance_between(drive.car, first));
    }
    EXPECT_LE(drive.car.x, 50) << "it drives back";
    EXPECT_GT(nearest, 0.02) << "[m]: touches nobody";
}

INSTANTIATE_TEST_SUITE_P(MetresBeforeTheEnd,
                         TurnAroundBeforeQueue,
                         testing::Range(11.7, 14.0, 0.1));

/// Who goes to and fro there needs the room behind it.
TEST(TurnAround, StaysAwayWhileAnotherTurnsAroundThere) {
    Drive drive(dead_end(3.2));
    drive.place(1, 60, 8);
    drive.cars = {car_at(1'000'000, road_end - 2, 0, 2)};
    for (int i = 0; i < 400; ++i)
        drive.step();
    EXPECT_LT(drive.car.x + drive.car.front(), road_end - 10);
    EXPECT_GT(drive.car.x + drive.car.front(), road_end - 14);
    drive.cars.clear();
    while (drive.car.x > 50 && drive.seconds() < 120)
        drive.step();
    EXPECT_LE(drive.car.x, 50) << "its turn comes";
}

/// A wreck across the end must not keep it for ever.
TEST(TurnAround, StaysAwayForHalfAMinuteAtMost) {
    Drive drive(dead_end(3.2));
    drive.place(1, 60, 8);
    drive.cars = {car_at(1'000'000, road_end + 2, -1.5, 2)};
    while (drive.car.x > 50 && drive.seconds() < 120)
        drive.step();
    EXPECT_LE(drive.car.x, 50);
}

TEST(TurnAround, WaitsForSomebodyBehindIt) {
    Drive drive = with_somebody_behind(0, 1.9);
    const KinematicCar before = drive.car;
    for (int i = 0; i < 50; ++i)
        drive.step();
    EXPECT_LT(std::hypot(drive.car.x - before.x, drive.car.y - before.y), 0.3);
    drive.walkers.clear();
    while (drive.car.x > 50 && drive.seconds() < 120)
        drive.step();
    EXPECT_LE(drive.car.x, 50) << "goes on when he is gone";
}

}  // namespace
}  // namespace reprise::test
