#include "traffic/rescue_lane.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/cars/fleet.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::lane;
using test::own_town;
using test::spawn;
using test::Stage;

constexpr std::uint32_t caller = 90;

BodyBox body_of(const Eigen::Vector2d& rear, double yaw, std::uint16_t model_index) {
    const world::VehicleModel& model = world::vehicle_models()[model_index];
    const Eigen::Vector2d ahead = world::ahead_of(yaw);
    return {rear + (model.length / 2 - model.rear_overhang) * ahead,
            ahead,
            model.length / 2,
            model.width / 2};
}

BodyBox body_of(const world::CarState& car) {
    return body_of(
        {car.position().x(), car.position().y()}, static_cast<double>(car.yaw()), car.model());
}

/// What the cars did that no car can, seen tick by tick.
class Watch {
  public:
    void see(const world::TickDraft& tick) {
        for (const world::CarState& car : tick.traffic.cars) {
            const Eigen::Vector2d place(car.position().x(), car.position().y());
            const auto before = places_.find(car.id());
            if (before != places_.end()) {
                const Eigen::Vector2d moved = place - before->second;
                const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(car.yaw()));
                const double driven = static_cast<double>(car.speed()) * 0.05;
                slid += std::abs(world::cross(ahead, moved)) > 0.6 * driven + 0.004;
                slid += moved.norm() > driven + 0.3;
            }
            places_[car.id()] = place;
        }
    }

    int slid = 0;

  private:
    std::map<std::uint32_t, Eigen::Vector2d> places_;
};

struct Drive {
    int touched = 0;   ///< ticks
    int slid = 0;      ///< car-ticks
    double aside = 0;  ///< [m] the farthest that any of them was, from its lane's middle
};

/// An ambulance with mass drives between the two inner lanes of a motorway, past a queue that
/// rolls.
Drive past_a_queue(bool lamps) {
    const auto& loaded = own_town("straight");
    const world::TownT& town = loaded.town;
    Stage stage(loaded, 0);
    const std::uint32_t outer = lane(town, "east_1");
    const std::uint32_t inner = lane(town, "east_2");
    std::vector<world::CommandT> commands;
    for (std::uint32_t i = 0; i < 8; ++i) {
        commands.push_back(spawn(10 + i, i % 2 == 0 ? outer : inner, 160 + 7.0 * i, 4));
        world::CommandT slowly = test::command(world::CommandKind::set_speed, 10 + i);
        slowly.speed = 4;
        commands.push_back(slowly);
    }
    const world::LaneT& on = town.lanes[outer];
    const std::uint16_t model = world::find_vehicle_model("ambulance").value();
    Drive drive;
    Watch watch;
    double s = 105;  // [m] of its origin
    for (int tick = 1; tick < 400; ++tick, s += 9 * 0.05) {
        const world::LanePoint at = world::point_at(on, s);
        const Eigen::Vector2d left = world::left_of(at.yaw);
        const Eigen::Vector2d origin = at.position.head<2>() + on.width / 2 * left;
        world::VehicleState vehicle = test::vehicle_at(caller, origin.x(), origin.y(), at.yaw, 9);
        vehicle.mutate_model(model);
        vehicle.mutate_lamps(lamps ? world::lamp_beacon : 0);
        const world::TickDraft& draft =
            stage.step(tick == 1 ? commands : std::vector<world::CommandT>(), {vehicle});
        watch.see(draft);
        const BodyBox own = body_of(origin, at.yaw, model);
        for (const world::CarState& car : draft.traffic.cars) {
            drive.touched += overlap(own, body_of(car));
            const Eigen::Vector3d place(car.position().x(), car.position().y(), 0);
            drive.aside =
                std::max(drive.aside, std::abs(world::project(town.lanes[car.lane()], place).t));
        }
        if (s > 250)
            break;
    }
    drive.slid = watch.slid;
    return drive;
}

TEST(RescueLane, OneWithBlueLampsComesThroughAQueueThatItWouldHitWithout) {
    const Drive with = past_a_queue(true);
    EXPECT_EQ(with.touched, 0);
    EXPECT_EQ(with.slid, 0) << "somebody moved without driving";
    EXPECT_GT(with.aside, 0.5);
    const Drive without = past_a_queue(false);
    EXPECT_GT(without.touched, 20) << "nothing is shown";
    EXPECT_LT(without.aside, 0.1);
}

/// A queue that stands does not jump aside.
TEST(RescueLane, WhoStandsStaysWhereHeIs) {
    const auto& loaded = own_town("town1");
    const world::TownT& town = loaded.town;
    Stage stage(loaded, 0);
    const std::uint32_t on = lane(town, "b1_l1_1");
    world::CommandT stop = test::command(world::CommandKind::set_speed, 10);
    stop.speed = 0;
    stage.step({spawn(10, on, 60), stop});
    stage.steps(20);
    const world::Vec3 before = stage.car(10)->position();
    for (int i = 0; i < 100; ++i) {
        world::VehicleState vehicle = test::vehicle_on(town.lanes[on], caller, 20, 5);
        vehicle.mutate_model(world::find_vehicle_model("ambulance").value());
        vehicle.mutate_lamps(world::lamp_beacon);
        stage.step({}, {vehicle});
    }
    EXPECT_EQ(stage.car(10)->position().x(), before.x());
    EXPECT_EQ(stage.car(10)->position().y(), before.y());
}

struct JunctionDrive {
    int ticks = 0;
    int touched = 0;
    int slid = 0;
};

/// SUMO's ambulance among others, until it is past the junction behind this lane.
JunctionDrive over_the_junction(const char* name, bool lamps, std::uint64_t seed) {
    const auto& loaded = own_town("town1");
    const world::TownT& town = loaded.town;
    Stage stage(loaded, 60, seed);
    if (lamps)
        stage.beacons = {caller};
    const std::uint32_t from = lane(town, name);
    world::CommandT ambulance = spawn(caller, from, 12, 8);
    ambulance.model = world::find_vehicle_model("ambulance").value();
    stage.step();
    stage.step({ambulance});
    JunctionDrive crossing;
    Watch watch;
    for (; crossing.ticks < 2400; ++crossing.ticks) {
        stage.step();
        watch.see(stage.draft());
        const world::CarState* own = stage.car(caller);
        if (own == nullptr)
            break;
        for (const world::CarState& car : stage.draft().traffic.cars)
            if (car.id() != caller)
                crossing.touched += overlap(body_of(*own), body_of(car));
        if (own->lane() != world::none &&
            town.lanes[own->lane()].kind == world::LaneKind::driving &&
            town.lanes[own->lane()].edge != town.lanes[from].edge)
            break;
    }
    crossing.slid = watch.slid;
    return crossing;
}

TEST(BlueLamps, TakeAnAmbulanceOverJunctionsSooner) {
    int with = 0;
    int without = 0;
    for (const char* name : {"l1_b1_1", "b1_l1_1", "r1_b3_1", "b2_b1_1", "b2_b3_1", "l1_b1_2"}) {
        const JunctionDrive lit = over_the_junction(name, true, 3);
        const JunctionDrive dark = over_the_junction(name, false, 3);
        EXPECT_EQ(lit.touched, 0) << name;
        EXPECT_EQ(lit.slid, 0) << name;
        with += lit.ticks;
        without += dark.ticks;
        RecordProperty(name, std::to_string(lit.ticks) + " of " + std::to_string(dark.ticks));
    }
    EXPECT_LT(with, without * 3 / 4) << "[ticks]";
}

}  // namespace
}  // namespace reprise::traffic
