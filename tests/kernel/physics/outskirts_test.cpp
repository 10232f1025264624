#include "kernel/physics/outskirts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/kernel/physics/physics_rig.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {
namespace {

/// Sixty metres beyond the last road a town ends: who went there fell for ever.
TEST(Outskirts, WhoDrivesOutOfATownDrivesOn) {
    const auto square = [](double half, double slope) {
        ground::GroundMesh mesh;
        for (const double x : {-half, half})
            for (const double y : {-half, half})
                mesh.vertices.emplace_back(x, y, slope * x);
        mesh.triangles = {{0, 2, 3}, {0, 3, 1}};
        mesh.surfaces.assign(2, ground::Surface::road);
        return mesh;
    };
    for (const double yaw : {0.0, 0.8, 2.0, -1.6}) {
        test::ProvingGround world(square(30, 0));
        world.add_vehicle("sedan", 10, 0, 0, yaw);
        for (int tick = 0; tick < 400; ++tick) {
            world.step(test::drive(1, 0));
            ASSERT_LT(std::abs(world.vehicle().position().z()), 0.05) << "tick " << tick;
        }
        EXPECT_GT(world::to_eigen(world.vehicle().position()).norm(), 200);
        EXPECT_EQ(world.tick().tick.wheels[0].surface(),
                  static_cast<std::uint8_t>(ground::Surface::terrain));
    }
    // Up a slope of a tenth to its upper end at 3 m, and on.
    test::ProvingGround hill(square(30, 0.1));
    hill.add_vehicle("sedan", 15);
    for (int tick = 0; tick < 200; ++tick)
        hill.step(test::drive(1, 0));
    EXPECT_GT(hill.vehicle().position().x(), 60);
    EXPECT_NEAR(hill.vehicle().position().z(), 3, 0.05);
}

TEST(Outskirts, HoldACarOnItsRoof) {
    ground::GroundMesh mesh = test::flat_ground();
    for (Eigen::Vector3d& v : mesh.vertices)
        v *= 0.01;
    test::ProvingGround world(mesh);
    const Eigen::Isometry3d on_its_roof =
        world::pose({60, -70, 2}, 0.4, 0) * Eigen::AngleAxisd(3, Eigen::Vector3d::UnitX());
    world.physics().add_vehicle(1, world::find_vehicle_model("sedan").value(), on_its_roof, 0);
    for (int tick = 0; tick < 200; ++tick)
        world.step(test::coasting());
    EXPECT_GT(world.vehicle().position().z(), 0.5);
    EXPECT_LT(world::to_eigen(world.vehicle().velocity()).norm(), 0.05);
}

}  // namespace
}  // namespace reprise::kernel
