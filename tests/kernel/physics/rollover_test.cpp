// Who was thrown off its wheels comes to rest, however it lies.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/kernel/physics/physics_rig.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::test {
namespace {

/// Turned about its own length, its lowest edge on the ground.
Eigen::Isometry3d rolled(const world::VehicleModel& model, double roll) {
    const Eigen::AngleAxisd turn(roll, Eigen::Vector3d::UnitX());
    double lowest = 0;
    for (const double y : {-model.width / 2, model.width / 2})
        for (const double z : {0.0, model.height})
            lowest = std::min(lowest, (turn * Eigen::Vector3d(0, y, z)).z());
    return Eigen::Translation3d(0, 0, -lowest) * turn;
}

class EveryModelThatRolledOver : public testing::TestWithParam<world::VehicleModel> {};

TEST_P(EveryModelThatRolledOver, LiesStill) {
    const world::VehicleModel& model = GetParam();
    const auto index = *world::find_vehicle_model(model.name);
    world::Control parked = coasting();
    parked.mutate_hand_brake(true);
    for (int degrees = -180; degrees <= 180; degrees += 18) {
        ProvingGround ground;
        ground.physics().add_vehicle(1, index, rolled(model, degrees * M_PI / 180), 0);
        for (int tick = 0; tick < 200; ++tick)
            ground.step(parked);
        const Eigen::Vector3d rests = world::to_eigen(ground.vehicle().position());
        for (int tick = 0; tick < 100; ++tick)
            ground.step(parked);
        const Eigen::Vector3d moved = world::to_eigen(ground.vehicle().position()) - rests;
        EXPECT_LT(moved.norm(), 0.1) << degrees << " degrees, in 5 s";
        EXPECT_LT(rests.head<2>().norm(), 4 * model.height) << degrees << " degrees";
    }
}

INSTANTIATE_TEST_SUITE_P(Rollover,
                         EveryModelThatRolledOver,
                         testing::ValuesIn(world::vehicle_models().begin(),
                                           world::vehicle_models().end()),
                         [](const auto& model) { return std::string(model.param.name); });

}  // namespace
}  // namespace reprise::test
