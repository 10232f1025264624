#include "walkers/road_users.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::walkers {
namespace {

constexpr double step = 0.05;  // [s]
constexpr std::uint32_t car_id = 1'000'000;

/// The only one there is, after that tick.
RoadUser seen(const world::SealedTick& tick) {
    RoadUsers users;
    users.look(tick.view(), step);
    EXPECT_EQ(users.all().size(), 1U);
    return users.all().front();
}

TEST(RoadUsers, AreInABendWhereTheNextTickHasThem) {
    constexpr double radius = 12;  // [m]
    constexpr double speed = 7;    // [m/s]
    const auto at = [&](int tick) {
        const double turned = tick * step * speed / radius;
        return test::car_at(
            car_id, radius * std::sin(turned), -radius * std::cos(turned), turned, speed);
    };
    RoadUsers users;
    for (const int tick : {1, 2})
        users.look(test::tick_with({}, {at(tick)}).view(), step);
    ASSERT_EQ(users.all().size(), 1U);
    const RoadUser user = users.all().front();
    const world::CarState next = at(3);
    EXPECT_LT((user.rear_axle - world::in_plan(next.position())).norm(), 0.006) << "of 0.35 m";
    EXPECT_NEAR(user.yaw, static_cast<double>(next.yaw()), 1e-5);
    EXPECT_NEAR(user.yaw_rate, speed / radius, 1e-4);
}

TEST(RoadUsers, WhoBrakesStopsAndDoesNotReverse) {
    world::CarState car = test::car_at(car_id, 10, 0, 0, 4);
    car.mutate_acceleration(-6);
    const RoadUser slower = seen(test::tick_with({}, {car}));
    EXPECT_NEAR(slower.speed, 3.7, 1e-6);
    EXPECT_NEAR(slower.rear_axle.x(), 10 + 4 * step - 6 * step * step / 2, 1e-6);
    car.mutate_speed(0.1F);
    EXPECT_EQ(seen(test::tick_with({}, {car})).speed, 0);
}

TEST(RoadUsers, WithMassAreForetoldAsWell) {
    world::VehicleState vehicle = test::vehicle_at(5, 20, 3, 0, 10);
    vehicle.mutable_angular_velocity() = world::Vec3(0, 0, 0.4);
    const RoadUser user = seen(test::tick_with({vehicle}));
    EXPECT_NEAR(user.rear_axle.x(), 20.5, 1e-3);
    EXPECT_NEAR(user.yaw, 0.02, 1e-9);
    EXPECT_EQ(user.lane, world::none) << "nobody has measured it";
}

}  // namespace
}  // namespace reprise::walkers
