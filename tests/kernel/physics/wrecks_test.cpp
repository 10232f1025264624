#include "kernel/physics/wrecks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/kernel/physics/physics_rig.h"
#include "tests/support/worlds.h"
#include "world/models/catalogue.h"

namespace reprise::test {
namespace {

double half_widths() {
    const auto models = world::vehicle_models();
    return (models[*world::find_vehicle_model("sedan")].width + models[0].width) / 2;
}

/// Half a centimetre beside it is near enough to be looked at as a body, and no touch.
TEST(Wrecks, WhoIsPassedByTheBreadthOfAFingerIsLeftAlone) {
    ProvingGround alone;
    ProvingGround beside;
    for (ProvingGround* ground : {&alone, &beside})
        ground->add_vehicle("sedan", 10);
    beside.cars = {car_at(9, 6, half_widths() + 0.005, 0, 0)};
    for (int tick = 0; tick < 40; ++tick) {
        alone.step(coasting());
        beside.step(coasting());
        ASSERT_EQ(alone.vehicle(), beside.vehicle()) << tick;
        ASSERT_EQ(beside.tick().tick.vehicles.size(), 1U) << tick;
        ASSERT_EQ(beside.tick().traffic.cars, beside.cars) << tick;
        ASSERT_TRUE(beside.tick().tick.events.empty()) << tick;
    }
}

TEST(Wrecks, WhoIsHitIsAVehicleInThatTickAndWasWhoItIs) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 10);
    ground.cars = {car_at(9, 8, 0), car_at(11, 30, 3.5)};
    int hits = 0;
    for (int tick = 0; tick < 40; ++tick) {
        ground.step(coasting());
        for (const kernel::Wreck& wreck : ground.physics().wrecks()) {
            EXPECT_EQ(wreck.id, 9U);
            EXPECT_EQ(wreck.by, 1U);
            EXPECT_EQ(wreck.speed, 0);
            EXPECT_EQ(ground.tick().traffic.cars.size(), 1U);
            ASSERT_EQ(ground.tick().tick.vehicles.size(), 2U);
            EXPECT_EQ(ground.tick().tick.vehicles[1].id(), 9U);
            EXPECT_EQ(ground.tick().tick.wheels.size(), 8U);
            ++hits;
        }
    }
    EXPECT_EQ(hits, 1);
}

TEST(Wrecks, APushOnIntoTheNextCarWrecksThatToo) {
    ProvingGround ground;
    ground.add_vehicle("lorry", 15);
    ground.cars = {car_at(9, 14, 0), car_at(10, 19, 0), car_at(11, 24, 0)};
    for (int tick = 0; tick < 60; ++tick)
        ground.step(coasting());
    EXPECT_EQ(ground.tick().tick.vehicles.size(), 4U);
}

TEST(Wrecks, GapsOfBoxesAreThoseThatARulerWouldFind) {
    const btVector3 half(2, 1, 0.5);
    const auto at = [&](double x, double y, double z, double yaw) {
        return kernel::PlacedBox{
            btTransform(btQuaternion(btVector3(0, 0, 1), yaw), btVector3(x, y, z)), half};
    };
    const kernel::PlacedBox here = at(0, 0, 0, 0);
    EXPECT_NEAR(gap_between(here, at(5, 0, 0, 0)), 1, 1e-12);
    EXPECT_NEAR(gap_between(here, at(0, 3, 0, M_PI / 2)), 0, 1e-12);
    EXPECT_NEAR(gap_between(here, at(0, 0, 1.25, 0.3)), 0.25, 1e-12);
    EXPECT_NEAR(gap_between(here, at(0, 2.2, 0, M_PI / 4)), 2.2 - 1 - 3 / std::sqrt(2), 1e-12);
    EXPECT_LT(gap_between(here, at(3.9, 0, 0, 0)), 0);
}

}  // namespace
}  // namespace reprise::test
