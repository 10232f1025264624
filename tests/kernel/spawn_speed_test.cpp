// A vehicle with mass is as fast as it was spawned.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::test {

namespace {

struct First {
    double speed = 0;
    double wheel_speed = 0;  ///< [m/s] of the first wheel's rim, over the second tick
    double rise = 0;         ///< [m/s] of the body, across the road
    bool in_contact = true;
};

/// Of the first ticks of one vehicle.
First first_ticks(const std::string& spawn, int count = 2) {
    const auto ticks = run(on_straight_lanes("spawn{ " + spawn + " } wait(9)", 0.05 * count));
    const world::TickView last = ticks.at(static_cast<std::size_t>(count - 1)).recorded().view;
    const world::TickView before = ticks.at(static_cast<std::size_t>(count - 2)).recorded().view;
    const world::VehicleState& car = last.vehicles()[0];
    const Eigen::Quaterniond turn = world::to_eigen(car.orientation());
    const Eigen::Vector3d v_car = turn.inverse() * world::to_eigen(car.velocity());
    const double radius = world::vehicle_models()[car.model()].wheel_radius;
    First first;
    first.speed = v_car.x();
    first.rise = v_car.z();
    const double turned = std::remainder(
        last.wheels()[0].rotation() - before.wheels()[0].rotation() - first.speed * 0.05 / radius,
        2 * 3.14159265358979);
    first.wheel_speed = first.speed + turned * radius / 0.05;
    for (const world::WheelState& wheel : last.wheels())
        first.in_contact = first.in_contact && wheel.in_contact();
    return first;
}

}  // namespace

TEST(SpawnSpeed, OfAnAutopilotIsKeptOnTheFlatUphillAndDownhill) {
    for (const char* lane : {"main_1", "hill_0", "hill_back_0"})
        for (const double kmh : {0, 5, 50, 120}) {
            const char* model = kmh == 50 ? "lorry" : "sedan";
            const First first = first_ticks(fmt::format(
                "model = '{}', lane = '{}', s = 100, speed_kmh = {}", model, lane, kmh));
            SCOPED_TRACE(fmt::format("{} on {} at {} km/h", model, lane, kmh));
            EXPECT_NEAR(first.speed, kmh / 3.6, 0.06);
            EXPECT_NEAR(first.wheel_speed, first.speed, 0.1);
            EXPECT_NEAR(first.rise, 0, 0.1) << "the springs are at rest";
            EXPECT_TRUE(first.in_contact);
        }
}

TEST(SpawnSpeed, IsKeptAboveTheLimitToo) {
    // 130 km/h is the limit: the driver wants 95 % of it, and brakes no harder than it likes.
    const First first =
        first_ticks("model = 'sedan', lane = 'main_1', s = 100, speed_kmh = 130", 2);
    EXPECT_NEAR(first.speed, 130 / 3.6, 0.1);
}

TEST(SpawnSpeed, IsKeptUntilSomebodyCanTakeTheWheel) {
    const std::string spawn =
        "model = 'sedan', lane = 'main_1', s = 100, speed = 20, driver = 'manual'";
    EXPECT_NEAR(first_ticks(spawn, 2).speed, 20 - 0.5, 0.15) << "then it brakes, as nobody does";
    const world::Recording recording = on_straight_lanes("spawn{ " + spawn + " } wait(9)", 0.05);
    EXPECT_NEAR(run(recording).at(0).recorded().view.vehicles()[0].velocity().x(), 20, 0.01);
}

}  // namespace reprise::test
