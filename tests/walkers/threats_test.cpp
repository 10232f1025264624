#include "walkers/threats.h"

#include <gtest/gtest.h>

#include "world/models/catalogue.h"

namespace reprise::walkers {
namespace {

constexpr double shoulders = 0.25;  // [m] half of them

/// One car of traffic with its rear axle at the origin, heading east.
Threats one_car(double speed, double acceleration = 0) {
    world::TickDraft next;
    next.traffic.cars.emplace_back(world::Vec3(0, 0, 0),
                                   0.0F,
                                   0.0F,
                                   static_cast<float>(speed),
                                   0.0F,
                                   7U,
                                   world::none,
                                   std::uint16_t{0},
                                   std::uint16_t{0},
                                   static_cast<float>(acceleration));
    world::TickDraft empty;
    const world::SealedTick last = world::seal(empty, {});
    Threats threats;
    threats.look(last.view(), next);
    return threats;
}

double front() {
    const world::VehicleModel& model = world::vehicle_models()[0];
    return model.length - model.rear_overhang;
}

TEST(Threats, SendWhoIsInTheWayOfACarToTheSideThatHeIsOn) {
    const Threats threats = one_car(5);
    const auto to_left = threats.way_out({front() + 4, 0.5}, shoulders);
    const auto to_right = threats.way_out({front() + 4, -0.5}, shoulders);
    ASSERT_TRUE(to_left && to_right);
    EXPECT_EQ(*to_left, Eigen::Vector2d(0, 1));
    EXPECT_EQ(*to_right, Eigen::Vector2d(0, -1));
}

TEST(Threats, AreNoneToWhoHasASecondLeftOrStandsAside) {
    const Threats threats = one_car(5);
    const double width = world::vehicle_models()[0].width;
    EXPECT_FALSE(threats.way_out({front() + 6, 0}, shoulders));
    EXPECT_FALSE(threats.way_out({front() + 2, width / 2 + 0.6}, shoulders));
    EXPECT_TRUE(threats.way_out({front() + 2, width / 2 + 0.5}, shoulders));
}

TEST(Threats, AreNoneFromCarsThatStandOrWillHaveStopped) {
    EXPECT_FALSE(one_car(0).way_out({front() + 0.3, 0}, shoulders));
    // From 5 m/s with 5 m/s^2: 2.5 m.
    EXPECT_FALSE(one_car(5, -5).way_out({front() + 3.2, 0}, shoulders));
    EXPECT_TRUE(one_car(5, -5).way_out({front() + 2.2, 0}, shoulders));
}

TEST(Threats, ComeFromWhoReversesAsWell) {
    const double rear = -world::vehicle_models()[0].rear_overhang;
    EXPECT_TRUE(one_car(-3).way_out({rear - 2, 0.1}, shoulders));
    EXPECT_FALSE(one_car(-3).way_out({front() + 2, 0.1}, shoulders));
}

}  // namespace
}  // namespace reprise::walkers
