#include "kernel/physics/physics.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/physics/vehicle.h"
#include "tests/kernel/physics/physics_rig.h"
#include "tests/support/worlds.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

using test::car_at;
using test::coasting;
using test::drive;
using test::ProvingGround;
using test::speed_of;
using test::tick_seconds;

const world::VehicleModel& sedan() {
    return world::vehicle_models()[world::find_vehicle_model("sedan").value()];
}

world::CarModel sedan_model() {
    return world::car_model(sedan());
}

std::vector<world::EventT> collisions(const ProvingGround& ground) {
    std::vector<world::EventT> found;
    for (const world::EventT& event : ground.tick().tick.events)
        if (event.kind == world::EventKind::collision)
            found.push_back(event);
    return found;
}

world::WalkerState adult_at(std::uint32_t id, double x, double y, bool down = false) {
    return {world::Vec3(x, y, 0), 0, 0, 0, id, 0, down, 0, 0};
}

/// Of the vehicle's mass, not of its rear axle. [m/s]
Eigen::Vector3d velocity_of_mass(const world::VehicleState& state) {
    const world::CarModel car = sedan_model();
    const Eigen::Vector3d arm =
        world::to_eigen(state.orientation()) * Eigen::Vector3d(car.com_ahead, 0, car.com_height);
    return world::to_eigen(state.velocity()) + world::to_eigen(state.angular_velocity()).cross(arm);
}

/// Drives the sedan freely for some ticks; sums the impulses, which are all from `other`.
double impulse_against(ProvingGround& ground, std::uint32_t other, int ticks) {
    double sum = 0;
    for (int tick = 0; tick < ticks; ++tick) {
        ground.step(coasting());
        for (const kernel::Impact& impact : ground.physics().impacts()) {
            if (impact.actor != 1)
                continue;  // of a car that is a body since it was hit
            EXPECT_EQ(impact.other, other);
            sum += impact.impulse;
        }
    }
    return sum;
}

TEST(Physics, CollisionImpulseIsTheMomentumThatTheVehicleLost) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 10);
    ground.cars = {car_at(9, 12, 0)};
    ground.step(coasting());
    const double before = velocity_of_mass(ground.vehicle()).x();
    const double impulse = impulse_against(ground, 9, 20);
    const double after = velocity_of_mass(ground.vehicle()).x();
    const double resistance =
        sedan_model().rolling_resistance * sedan().mass * world::gravity * 1.0;
    EXPECT_GT(impulse, 7'000);
    EXPECT_NEAR(impulse, sedan().mass * (before - after), 0.02 * impulse + resistance);
}

TEST(Physics, HitOnAMovingCarCountsTheRelativeSpeed) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 12);
    double impulse = 0;
    for (int tick = 0; tick < 60 && impulse == 0; ++tick) {
        ground.cars = {car_at(9, 7 + 8 * tick * tick_seconds, 0, 0, 8)};
        impulse += impulse_against(ground, 9, 1);
    }
    // Both have mass: from 12 and 8 m/s to what they have in common, and up to a third of that
    // back.
    const double struck = world::vehicle_models()[ground.tick().tick.vehicles.back().model()].mass;
    const double plastic = 4 / (1 / sedan().mass + 1 / struck);
    EXPECT_GT(impulse, 0.85 * plastic);
    EXPECT_LT(impulse, 1.35 * plastic);
}

TEST(Physics, CarFromBehindSharesItsMomentumWithAStandingVehicle) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 0);
    // It comes from beyond the distance at which boxes enter Bullet.
    for (int tick = 0; tick < 150; ++tick) {
        ground.cars = {car_at(9, -90 + 15 * tick * tick_seconds, 0, 0, 15)};
        ground.step(coasting());
    }
    const double struck = world::vehicle_models()[ground.tick().tick.vehicles.back().model()].mass;
    const double shared = 15 * struck / (struck + sedan().mass);
    EXPECT_GT(speed_of(ground.vehicle()), 0.9 * shared);
    EXPECT_LT(speed_of(ground.vehicle()), 1.2 * shared);
}

TEST(Physics, CarThatIsPutElsewhereHasNoSpeed) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 0);
    ground.cars = {car_at(9, 40, 0)};
    ground.step(coasting());
    ground.cars = {car_at(9, -20, 0)};  // on the other side of the vehicle
    EXPECT_EQ(impulse_against(ground, 0, 20), 0);
    EXPECT_LT(std::abs(speed_of(ground.vehicle())), 0.01);
}

TEST(Physics, CarsOutOfReachChangeNothing) {
    ProvingGround alone;
    ProvingGround among;
    for (ProvingGround* ground : {&alone, &among})
        ground->add_vehicle("sedan", 20);
    for (int tick = 0; tick < 100; ++tick) {
        among.cars = {car_at(7, -150 - tick, 30, 1, 20), car_at(9, 300, 40)};
        const world::Control control = drive(0.3, 0, std::sin(0.1 * tick));
        alone.step(control);
        among.step(control);
        ASSERT_EQ(alone.vehicle(), among.vehicle()) << tick;
        ASSERT_EQ(alone.physics().digest(), among.physics().digest()) << tick;
    }
}

TEST(Physics, NearCarsThatAreNotTouchedDoNotMoveAVehicle) {
    ProvingGround alone;
    ProvingGround among;
    for (ProvingGround* ground : {&alone, &among})
        ground->add_vehicle("sedan", 10);
    for (int tick = 0; tick < 60; ++tick) {
        among.cars = {car_at(7, 5 + 10 * tick * tick_seconds, 4, 0, 10), car_at(9, 30, -6, 1.5)};
        alone.step(drive(0.3, 0));
        among.step(drive(0.3, 0));
        ASSERT_EQ(alone.vehicle(), among.vehicle()) << tick;
    }
    EXPECT_NE(alone.physics().digest(), among.physics().digest());  // but they are in Bullet
}

/// A lively scene: two vehicles, a crash, a building, trees and a kerb.
struct Scene {
    explicit Scene(double steer_nudge = 0)
        : ground(test::kerb_ground(40, 0.15), town()),
          nudge(steer_nudge) {
        ground.add_vehicle("sedan", 15);
        ground.physics().add_vehicle(5, 4, world::pose({20, 6, 0}, -1.2, 0), 3);
    }

    static world::TownT town() {
        world::TownT town;
        town.buildings.emplace_back(world::Vec3(60, 3, 0), 0.3, 10, 8, 12, 0u, 0u);
        town.trees.emplace_back(world::Vec3(48, -2, 0), 8, 2, 0u, world::PlantKind::any);
        return town;
    }

    void step(int tick) {
        ground.cars = {car_at(9, 8 + 0.3 * tick, 2.2, 0.05, 6), car_at(11, 50, 0, 1)};
        world::Control control = drive(0.6, 0, 0.1 * std::sin(0.2 * tick));
        if (tick == 10)
            control.mutate_steer(control.steer() + nudge);
        ground.step(control);
    }

    ProvingGround ground;
    double nudge;
};

TEST(Physics, EqualInputsGiveEqualDigestsInEveryTick) {
    Scene one;
    Scene other;
    std::size_t hits = 0;
    for (int tick = 0; tick < 120; ++tick) {
        one.step(tick);
        other.step(tick);
        ASSERT_EQ(one.ground.physics().digest(), other.ground.physics().digest()) << tick;
        ASSERT_EQ(one.ground.tick().tick, other.ground.tick().tick) << tick;
        hits += one.ground.physics().impacts().size();
    }
    EXPECT_GT(hits, 2u);
}

TEST(Physics, OneUnitInTheLastPlaceOfSteeringShowsInTheSameTick) {
    const double steer = 0.1 * std::sin(2.0);
    Scene one;
    Scene other(std::nextafter(steer, 1) - steer);
    for (int tick = 0; tick < 20; ++tick) {
        one.step(tick);
        other.step(tick);
        if (tick < 10)
            ASSERT_EQ(one.ground.physics().digest(), other.ground.physics().digest()) << tick;
        else
            ASSERT_NE(one.ground.physics().digest(), other.ground.physics().digest()) << tick;
    }
}

TEST(Physics, WalkerIsHitOnceWithHisMassTimesTheClosingSpeed) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 8);
    ground.walkers = {adult_at(20, 9, 0.3)};
    int hits = 0;
    double before = 8;
    for (int tick = 0; tick < 40; ++tick) {
        const double speed = velocity_of_mass(ground.step(coasting())).x();
        for (const world::EventT& event : collisions(ground)) {
            ++hits;
            EXPECT_EQ(event.other, 20u);
            EXPECT_NEAR(event.value, world::walker_models()[0].mass * before, 0.02 * event.value);
            EXPECT_NEAR(sedan().mass * (before - speed), event.value, 0.05 * event.value);
            EXPECT_NEAR(event.position.x(), 8.77, 0.4);
            EXPECT_NEAR(event.position.y(), 0.3, 0.01);
        }
        before = speed;
    }
    EXPECT_EQ(hits, 1);
}

TEST(Physics, WalkerBesideTheRoadOrLyingDownIsNotHit) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 8);
    ground.walkers = {adult_at(20, 9, 1.3), adult_at(21, 12, 0, true)};
    EXPECT_EQ(impulse_against(ground, 0, 40), 0);
}

TEST(Physics, WalkerWhoRunsIntoAStandingVehicleIsNoCollision) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 0);
    double impulse = 0;
    for (int tick = 0; tick < 40; ++tick) {
        ground.walkers = {adult_at(20, 1, 3 - 2 * tick * tick_seconds)};
        impulse += impulse_against(ground, 20, 1);
    }
    EXPECT_EQ(impulse, 0);
}

TEST(Physics, BuildingsAndTreesStopAVehicle) {
    world::TownT town;
    town.buildings.emplace_back(world::Vec3(30, 0, 0), 0.0, 10, 10, 12, 0u, 0u);
    town.trees.emplace_back(world::Vec3(15, 50, 0), 8, 2, 0u, world::PlantKind::any);
    for (const double y : {0.0, 50.0}) {
        ProvingGround ground(test::flat_ground(), town);
        ground.add_vehicle("sedan", 10, 0, y);
        const double impulse = impulse_against(ground, 0, 60);
        EXPECT_GT(impulse, 0.8 * sedan().mass * 10) << y;
        EXPECT_LT(speed_of(ground.vehicle()), 0.1) << y;
    }
}

TEST(Physics, TwoVehiclesWithMassKeepTheirMomentumAndEachFindsTheHit) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 10);
    ground.physics().add_vehicle(4, 0, world::pose({12, 0, 0}, 0, 0), 0);
    double of_one = 0;
    double of_four = 0;
    int begun = 0;
    for (int tick = 0; tick < 20; ++tick) {
        ground.step(coasting());
        for (const kernel::Impact& impact : ground.physics().impacts())
            (impact.actor == 1 ? of_one : of_four) += impact.impulse;
        for (const world::EventT& event : collisions(ground)) {
            EXPECT_EQ(std::pair(event.actor, event.other), std::pair(1u, 4u));
            ++begun;
        }
    }
    EXPECT_EQ(begun, 1) << "one for both";
    EXPECT_GT(of_one, 1000);
    EXPECT_DOUBLE_EQ(of_one, of_four);
    const auto& vehicles = ground.tick().tick.vehicles;
    const double sum = velocity_of_mass(vehicles[0]).x() + velocity_of_mass(vehicles[1]).x();
    EXPECT_NEAR(sum, 10, 0.3);  // a second of rolling resistance
}

TEST(Physics, KerbsAndSpringsMakeNoCollisions) {
    ProvingGround ground(test::kerb_ground(12, ground::kerb_height));
    ground.add_vehicle("sedan", 5);
    EXPECT_EQ(impulse_against(ground, 0, 60), 0);
}

TEST(Physics, VehicleThatFallsOnItsRoofHitsTheGround) {
    ProvingGround ground;
    const Eigen::Isometry3d upside_down =
        Eigen::Translation3d(0, 0, 3) *
        Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
    ground.physics().add_vehicle(1, 0, upside_down, 0);
    const double impulse = impulse_against(ground, 0, 30);
    const double fallen = 3 - sedan().height;
    EXPECT_GT(impulse, 0.9 * sedan().mass * std::sqrt(2 * world::gravity * fallen));
    for (int tick = 0; tick < 100; ++tick)
        ground.step(coasting());
    EXPECT_LT(world::to_eigen(ground.vehicle().velocity()).norm(), 0.05);
}

TEST(Physics, WritesVehiclesAndWheelsSortedByIdWhateverTheOrderOfTheirComing) {
    ProvingGround ground;
    for (const std::uint32_t id : {8u, 3u, 5u})
        ground.physics().add_vehicle(id, 0, world::pose({0, 10.0 * id, 0}, 0, 0), 0);
    ground.physics().remove_vehicle(5);
    ground.step(coasting(3));
    const auto& tick = ground.tick().tick;
    ASSERT_EQ(tick.vehicles.size(), 2u);
    EXPECT_EQ(tick.vehicles[0].id(), 3u);
    EXPECT_EQ(tick.vehicles[1].id(), 8u);
    ASSERT_EQ(tick.wheels.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(tick.wheels[i].vehicle(), i < 4 ? 3u : 8u);
        EXPECT_EQ(tick.wheels[i].index(), i % 4);
    }
}

TEST(Physics, KeepsTheLastControlOfAVehicleThatGetsNone) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 0);
    ground.step(drive(1, 0));
    for (int tick = 0; tick < 20; ++tick)
        ground.step(coasting(77));
    EXPECT_GT(speed_of(ground.vehicle()), 3);
}

}  // namespace

}  // namespace reprise::kernel
