#include "drivers/control/wide_turn.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ground/obstacles.h"
#include "tests/drivers/kinematic_car.h"

namespace reprise::test {
namespace {

using drivers::Path;
using drivers::WideTurnPlan;

constexpr double quarter_turn = std::numbers::pi / 2;

const world::VehicleModel& model_of(const char* name) {
    return world::vehicle_models()[*world::find_vehicle_model(name)];
}

Path path_along(const Turtle& turtle) {
    std::vector<Eigen::Vector3d> line;
    for (const world::Vec3& point : turtle.line())
        line.push_back(world::to_eigen(point));
    Path path;
    path.append(line, 10);
    path.finish({});
    return path;
}

/// A bus and the like on the first metres of a path that starts eastwards.
drivers::Ego ego_at(const world::VehicleModel& model, double x, double y) {
    drivers::Ego ego;
    ego.model = &model;
    ego.position = {x, y, 0};
    ego.direction = {1, 0};
    ego.rear_axle_s = x;
    return ego;
}

/// A lane that turns right around a corner whose kerb has a radius of 6 m, as those of our towns;
/// beyond a second lane on its left is the other kerb.
world::TownT corner() {
    const double kerb = 6;
    const auto line = [&](double left) {
        return Turtle(0, left, 0).ahead(60).turn(-quarter_turn, kerb + 1.75 + left).ahead(60);
    };
    world::TownT town;
    town.name = "corner";
    town.lanes = {make_lane("inner", line(-3), 5, world::LaneKind::sidewalk),
                  make_lane("outer", line(3.5 + 3), 5, world::LaneKind::sidewalk),
                  make_lane("way", line(0))};
    town.lanes[0].width = town.lanes[1].width = 2.5;
    return town;
}

world::Prop pole_at(double x, double y) {
    return {world::Vec3(x, y, 0), 0, 0.1, 0.1, 3, 0, 0, world::PropKind::pole, 0};
}

/// Places of the outline, half a metre apart. Metres to the left are positive.
std::vector<Eigen::Vector2d> outline_of(const world::VehicleModel& model,
                                        const Eigen::Vector2d& axle,
                                        double yaw) {
    const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw));
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    std::vector<Eigen::Vector2d> places;
    for (double x = 0; x <= model.length; x += 0.5)
        for (const double y : {-model.width / 2, model.width / 2})
            places.push_back(axle + (x - model.rear_overhang) * ahead + y * left);
    return places;
}

class LongVehicles : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All,
                         LongVehicles,
                         testing::Values("bus", "lorry", "minibus", "ambulance"),
                         [](const auto& of) { return std::string(of.param); });

/// R_rear^2 = R^2 - a^2 for a point `a` ahead of the rear axle on a circle of R; the front axle, L
/// ahead, makes R_front^2 = R_rear^2 + L^2 (any textbook on turning, such as Gillespie, ch. 6).
TEST_P(LongVehicles, CutACircleByWhatTheTextbookSays) {
    const world::VehicleModel& model = model_of(GetParam());
    world::TownT town;
    town.name = "meadow";
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    for (const double radius : {15.0, 40.0}) {
        const Path path = path_along(Turtle(0, 0, 0).turn(1.5 * std::numbers::pi, radius));
        WideTurnPlan wide_turn(model, clearances);
        wide_turn.plan(path, ego_at(model, 0, 0));
        const drivers::WideTurnPoint middle = wide_turn.at(path.end() / 2);
        const double rear = std::sqrt(radius * radius - model.wheelbase * model.wheelbase / 4);
        const Eigen::Vector2d centre(0, radius);
        EXPECT_NEAR((middle.position - centre).norm(), rear, 0.03) << "radius " << radius;
        EXPECT_NEAR(middle.curvature, 1 / rear, 0.02 / rear) << "radius " << radius;
        const Eigen::Vector2d front =
            middle.position +
            model.wheelbase * Eigen::Vector2d(std::cos(middle.yaw), std::sin(middle.yaw));
        EXPECT_NEAR((front - centre).norm(), std::hypot(rear, model.wheelbase), 0.03);
    }
}

TEST_P(LongVehicles, KeepOffTheKerbsOfATightCorner) {
    const auto index = *world::find_vehicle_model(GetParam());
    const world::VehicleModel& model = world::vehicle_models()[index];
    Drive drive(corner(), 7, index);
    drive.place(2, 5, 8);
    double sharpest = 0;
    while (drive.seconds() < 40 && drive.car.y > -40) {
        drive.step();
        for (const Eigen::Vector2d& place :
             outline_of(model, {drive.car.x, drive.car.y}, drive.car.yaw))
            ASSERT_TRUE(drive.lanes.walkable_at({place.x(), place.y(), 0}).empty())
                << place.transpose() << " at " << drive.seconds() << " s";
        sharpest = std::max(sharpest, std::abs(drive.car.steering_angle));
    }
    EXPECT_LT(drive.car.y, -40) << "does not get round";
    EXPECT_LT(sharpest, model.max_steering_angle);
}

/// A tighter one, with grass where the sidewalks are. An ego that swung out over it to turn right
/// met the slab of a sidewalk further on.
TEST_P(LongVehicles, StayOnTheRoadWhereGrassIsBeside) {
    const auto index = *world::find_vehicle_model(GetParam());
    const world::VehicleModel& model = world::vehicle_models()[index];
    world::TownT town;
    town.name = "corner";
    const double tightest = 3.4;
    for (const double left : {0.0, 3.5})
        town.lanes.push_back(make_lane(
            "lane", Turtle(0, left, 0).ahead(60).turn(-quarter_turn, tightest + left).ahead(60)));
    Drive drive(town, 7, index);
    drive.place(0, 5, 8);
    double off = 0;  // [m] farthest beside the road
    while (drive.seconds() < 40 && drive.car.y > -40) {
        drive.step();
        for (const Eigen::Vector2d& place :
             outline_of(model, {drive.car.x, drive.car.y}, drive.car.yaw))
            while (off < 3 && drive.lanes.at({place.x(), place.y(), 0}, off).empty())
                off += 0.05;
    }
    EXPECT_LT(drive.car.y, -40) << "does not get round";
    EXPECT_LT(off, 0.6);
}

TEST(WideTurnPlan, WaitsForTheCarThatItWouldSwingInto) {
    const auto index = *world::find_vehicle_model("bus");
    const world::VehicleModel& bus = world::vehicle_models()[index];
    Drive drive(corner(), 7, index);
    drive.place(2, 5, 8);
    // A sedan waits on the other lane, behind the corner: its sides are beside our own lane.
    drive.cars = {car_at(1'000'000, 71.25, -12, quarter_turn)};
    const auto is_in_it = [](const Eigen::Vector2d& p) {
        return std::abs(p.x() - 71.25) < 0.91 && p.y() > -13.0 && p.y() < -8.3;
    };
    while (drive.seconds() < 25) {
        drive.step();
        for (const Eigen::Vector2d& place :
             outline_of(bus, {drive.car.x, drive.car.y}, drive.car.yaw))
            ASSERT_FALSE(is_in_it(place)) << place.transpose();
    }
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_GT(drive.car.x, 30) << "far too early";
    drive.cars.clear();
    while (drive.seconds() < 60 && drive.car.y > -40)
        drive.step();
    EXPECT_LT(drive.car.y, -40) << "does not go on";
}

/// To the right where two roads of two lanes of 3.2 m cross, as netconvert makes it: the turn is
/// tighter than a car's, and on the other half of the road that it leads to somebody waits.
world::TownT crossroads() {
    const double lane = 3.2;
    const double radius = 3.6;
    world::TownT town;
    town.name = "crossroads";
    town.lanes = {
        make_lane("in", Turtle(0, 0, 0).ahead(60)),
        make_lane(
            ":turn", Turtle(60, 0, 0).turn(-quarter_turn, radius), 5, world::LaneKind::internal),
        make_lane("out", Turtle(60 + radius, -radius, -quarter_turn).ahead(60)),
        make_lane("beside", Turtle(60, lane, std::numbers::pi).ahead(60)),
        make_lane("waiting", Turtle(60 + radius + lane, -radius - 60, quarter_turn).ahead(60))};
    for (world::LaneT& one : town.lanes)
        one.width = static_cast<float>(lane);
    town.lanes[0].links = {make_link(2, 1, world::Turn::right)};
    town.lanes[1].links = {make_link(2, world::none, world::Turn::right)};
    town.lanes[4].links = {make_link(3, world::none, world::Turn::left)};
    town.junctions.resize(1);
    const double right = 60 + radius + 1.5 * lane;
    for (const auto& [x, y] :
         {std::pair(60.0, -radius), {right, -radius}, {right, 1.5 * lane}, {60.0, 1.5 * lane}})
        town.junctions[0].outline.emplace_back(x, y, 0);
    return town;
}

/// 188 s an ego stood at green before one who waited at red, and whoever came behind him.
TEST(WideTurnPlan, LeavesRoomForWhoWaitsAtTheLineBesideItsWayOut) {
    constexpr double room = 0.25;  // [m]
    const world::TownT town = crossroads();
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    const Path path = path_along(Turtle(0, 0, 0).ahead(60).turn(-quarter_turn, 3.6).ahead(60));
    const Eigen::Vector2d line(66.8, -3.6);
    for (const char* name : {"sedan", "pickup", "van"}) {
        const world::VehicleModel& model = model_of(name);
        WideTurnPlan wide_turn(model, clearances);
        wide_turn.plan(path, ego_at(model, 30, 0));
        for (double s = 40; s < 90; s += 0.1) {
            const drivers::WideTurnPoint point = wide_turn.at(s);
            for (const Eigen::Vector2d& place : outline_of(model, point.position, point.yaw)) {
                const Eigen::Vector2d from = place - line;
                ASSERT_FALSE(std::abs(from.x()) < 0.95 + room && from.y() < -1 + room &&
                             from.y() > -7)
                    << name << " at " << place.transpose();
            }
        }
    }
}

TEST(WideTurnPlan, LeavesRoomForAPoleBesideTheLane) {
    const world::VehicleModel& bus = model_of("bus");
    world::TownT town;
    town.name = "pole";
    town.lanes.push_back(make_lane("way", Turtle(0, 0, 0).ahead(120)));
    town.props.push_back(pole_at(60, -1.4));
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    WideTurnPlan wide_turn(bus, clearances);
    const Path path = path_along(Turtle(0, 0, 0).ahead(120));
    wide_turn.plan(path, ego_at(bus, 0, 0));
    double nearest = 100;
    for (double s = 40; s < 80; s += 0.1) {
        const drivers::WideTurnPoint point = wide_turn.at(s);
        for (const Eigen::Vector2d& place : outline_of(bus, point.position, point.yaw))
            nearest = std::min(nearest, (place - Eigen::Vector2d(60, -1.4)).norm());
    }
    EXPECT_GT(nearest, 0.3);
    EXPECT_NEAR(wide_turn.at(10).position.y(), 0, 0.02) << "swings far too early";
    EXPECT_NEAR(wide_turn.at(110).position.y(), 0, 0.02) << "does not come back";
}

TEST(WideTurnPlan, KeepsToTheLaneOnAStraightRoad) {
    const world::TownT town = straight_road(200);
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    WideTurnPlan wide_turn(model_of("bus"), clearances);
    wide_turn.plan(path_along(Turtle(0, -1.75, 0).ahead(200)), ego_at(model_of("bus"), 0, -1.75));
    for (double s = 0; s < 200; s += 1) {
        EXPECT_NEAR(wide_turn.at(s).position.y(), -1.75, 1e-6);
        EXPECT_NEAR(wide_turn.at(s).curvature, 0, 1e-6);
    }
}

TEST(WideTurnPlan, GoesOnFromWhereTheVehicleIs) {
    const world::TownT town = straight_road(200);
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    const world::VehicleModel& bus = model_of("bus");
    WideTurnPlan wide_turn(bus, clearances);
    drivers::Ego ego = ego_at(bus, 50, -1.0);
    ego.steering_angle = -0.1;
    wide_turn.plan(path_along(Turtle(0, -1.75, 0).ahead(200)), ego);
    EXPECT_NEAR(wide_turn.at(50).position.y(), -1.0, 0.02);
    EXPECT_NEAR(wide_turn.at(50).yaw, 0, 0.02);
    EXPECT_NEAR(wide_turn.at(50).curvature, std::tan(-0.1) / bus.wheelbase, 0.01);
    EXPECT_NEAR(wide_turn.at(100).position.y(), -1.75, 0.1);
}

TEST(WideTurnPlan, DependsOnPathAndPlaceNotOnWhatWasPlannedBefore) {
    const world::TownT town = corner();
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    Path path;
    std::vector<Eigen::Vector3d> line;
    for (const world::Vec3& point : town.lanes[2].centre)
        line.push_back(world::to_eigen(point));
    ASSERT_GT(line.size(), 12u);
    path.append(std::span(line).first(8), 10);
    path.finish({});
    drivers::Ego ego = ego_at(model_of("bus"), 5, 0);
    WideTurnPlan experienced(model_of("bus"), clearances);
    experienced.plan(path, ego);
    path.append(std::span(line).subspan(7), 10);
    path.finish({});
    experienced.plan(path, ego);
    path.drop_before(30);
    ego = ego_at(model_of("bus"), 40, 0.1);
    experienced.plan(path, ego);
    WideTurnPlan fresh(model_of("bus"), clearances);
    fresh.plan(path, ego);
    for (double s = 40; s < path.end(); s += 0.7) {
        EXPECT_EQ(experienced.at(s).position, fresh.at(s).position) << s;
        EXPECT_EQ(experienced.at(s).curvature, fresh.at(s).curvature) << s;
    }
}

TEST(WideTurnPlan, AsksForNoMoreThanTheSteeringCanGive) {
    const world::VehicleModel& bus = model_of("bus");
    world::TownT town;
    town.name = "meadow";
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    WideTurnPlan wide_turn(bus, clearances);
    const Path path = path_along(Turtle(0, 0, 0).ahead(40).turn(std::numbers::pi, 6).ahead(40));
    wide_turn.plan(path, ego_at(bus, 0, 0));
    double sharpest = 0;
    for (double s = 0; s < path.end(); s += 0.5)
        sharpest = std::max(sharpest, wide_turn.at(s).curvature);
    EXPECT_LT(sharpest, std::tan(bus.max_steering_angle) / bus.wheelbase);
    EXPECT_GT(sharpest, 0.1) << "does not turn";
}

TEST(WideTurnPlan, SlowsDownBeforeABendAndNotOnAStraight) {
    const world::TownT town = corner();
    const world::LaneMap lanes(town);
    const drivers::LateralClearances clearances(town, lanes, ground::obstacles_of(town));
    WideTurnPlan wide_turn(model_of("bus"), clearances);
    const Path path = path_along(Turtle(0, 0, 0).ahead(60).turn(-quarter_turn, 7.75).ahead(60));
    wide_turn.plan(path, ego_at(model_of("bus"), 0, 0));
    const double slow = wide_turn.at(66).squared_speed;
    EXPECT_LT(slow * std::abs(wide_turn.at(66).curvature), 1.51);
    EXPECT_GT(slow, 4) << "crawls";
    EXPECT_GT(wide_turn.at(10).squared_speed, 100);
    EXPECT_GT(wide_turn.at(110).squared_speed, 100);
}

}  // namespace
}  // namespace reprise::test
