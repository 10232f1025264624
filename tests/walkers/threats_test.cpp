#include "walkers/threats.h"

#include <cmath>

#include <gtest/gtest.h>

#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::walkers {
namespace {

constexpr double shoulders = 0.25;  // [m] half of them

void put(world::TickDraft& tick,
         double yaw,
         double speed,
         double acceleration = 0,
         std::uint16_t model = 0) {
    tick.traffic.cars.emplace_back(world::Vec3(0, 0, 0),
                                   static_cast<float>(yaw),
                                   0.0F,
                                   static_cast<float>(speed),
                                   0.0F,
                                   7U,
                                   world::none,
                                   model,
                                   std::uint16_t{0},
                                   static_cast<float>(acceleration));
}

Threats threats_of(world::TickDraft before, world::TickDraft now) {
    RoadUsers users;
    for (world::TickDraft* tick : {&before, &now}) {
        const world::SealedTick sealed = world::seal(*tick, {});
        users.look(sealed.view(), 0.05);
    }
    Threats threats;
    threats.look(users.all());
    return threats;
}

/// One car of traffic with its rear axle at the origin, heading east.
Threats one_car(double speed, double acceleration = 0) {
    world::TickDraft next;
    put(next, 0, speed, acceleration);
    return threats_of({}, next);
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

TEST(Threats, ComeFromABusThatHardlyRolls) {
    const std::uint16_t bus = world::find_vehicle_model("bus").value();
    const Eigen::Vector2d beside(1, world::vehicle_models()[bus].width / 2 + 0.3);
    for (const double speed : {0.0, 0.1}) {
        world::TickDraft next;
        put(next, 0, speed, 0, bus);
        EXPECT_EQ(threats_of({}, next).way_out(beside, shoulders).has_value(), speed > 0) << speed;
    }
    EXPECT_FALSE(one_car(0.1).way_out({1, world::vehicle_models()[0].width / 2 + 0.3}, shoulders));
}

/// The rear of a bus that turns left goes to the right.
TEST(Threats, ComeFromTheTailOfABusThatTurns) {
    constexpr std::uint16_t bus = 5;
    const world::VehicleModel& model = world::vehicle_models()[bus];
    ASSERT_STREQ(model.name, "bus");
    const Eigen::Vector2d beside_its_tail(-1.0, -(model.width / 2 + shoulders + 0.5));
    world::TickDraft before;
    world::TickDraft now;
    put(before, 0, 6.5, 0, bus);
    put(now, 0, 6.5, 0, bus);
    EXPECT_EQ(threats_of(before, now).way_out(beside_its_tail, shoulders), std::nullopt);
    world::TickDraft turned;
    put(turned, 0.5 * 0.05, 6.5, 0, bus);
    const auto way = threats_of(before, turned).way_out(beside_its_tail, shoulders);
    ASSERT_TRUE(way);
    EXPECT_LT(way->y(), 0);
}

/// One that stood in its bend, and starts: by the time that it is seen to turn fast it is too late.
TEST(Threats, ComeFromTheTailOfABusThatStartsInABend) {
    constexpr std::uint16_t bus = 5;
    constexpr double speed = 0.45;
    constexpr double bend = 0.105;  // [1/m]
    const world::VehicleModel& model = world::vehicle_models()[bus];
    const Eigen::Vector2d beside_its_tail(1 - model.rear_overhang,
                                          -(model.width / 2 + shoulders + 0.35));
    world::TickDraft before;
    world::TickDraft starts;
    world::TickDraft rolls;
    put(before, 0, speed, 0, bus);
    put(starts, bend * speed * 0.05, speed, 1.1, bus);
    put(rolls, bend * speed * 0.05, speed, 0, bus);
    const auto way = threats_of(before, starts).way_out(beside_its_tail, shoulders);
    ASSERT_TRUE(way);
    EXPECT_LT(way->y(), 0);
    EXPECT_EQ(threats_of(before, rolls).way_out(beside_its_tail, shoulders), std::nullopt)
        << "half a metre on, as it goes on like this";
}

/// Its bumper goes straight on by now, and its rear axle still comes from the street that it turned
/// out of: onto the bumper's line, not over it.
TEST(Threats, FromATailEndWhereTheBusIsStraightAgain) {
    constexpr std::uint16_t bus = 5;
    constexpr double speed = 2.9;
    constexpr double aside = 0.45;  // [rad] that the rear axle goes to the left of where it points
    const world::VehicleModel& model = world::vehicle_models()[bus];
    const double to_bumper = model.length - model.rear_overhang;
    const double bumper_goes = -0.09;  // [rad]
    const double turns = speed / to_bumper * (std::sin(bumper_goes) - std::sin(aside));
    world::TickDraft before;
    world::TickDraft now;
    put(before, -0.05 * turns, speed, 0, bus);
    before.traffic.cars.back().mutable_position() =
        world::Vec3(-0.05 * speed * std::cos(aside), -0.05 * speed * std::sin(aside), 0);
    put(now, 0, speed, 0, bus);
    const Threats threats = threats_of(before, now);
    double reach = 0;  // [m] left of it
    while (threats.way_out({1, reach + 0.01}, shoulders))
        reach += 0.01;
    const double line = to_bumper * -std::sin(bumper_goes);
    EXPECT_GT(reach, model.width / 2 + 0.5 * line) << "the tail does swing out";
    EXPECT_LT(reach, model.width / 2 + line + shoulders + 0.3 + 0.25);
}

/// A bus comes by on one side, a car on the other.
TEST(Threats, OnBothSidesLeaveAPlaceBetween) {
    const auto straight_on = [](const Eigen::Vector2d& there) { return there; };
    const double half = world::vehicle_models()[0].width / 2;
    const Eigen::Vector2d p(front() + 1, half + 0.4);
    world::TickDraft one;
    put(one, 0, 5);
    const Eigen::Vector2d to_left(0, 1);
    EXPECT_EQ(threats_of({}, one).way_out(p, shoulders), to_left);
    EXPECT_EQ(threats_of({}, one).to_between(p, to_left, shoulders, straight_on), world::infinity)
        << "nobody comes on that side";
    for (const double gap : {1.2, 0.5}) {
        world::TickDraft both;
        put(both, 0, 5);
        put(both, 0, 5);
        both.traffic.cars.back().mutable_position() = world::Vec3(0, 2 * half + gap, 0);
        both.traffic.cars.back().mutate_id(8);
        const Threats threats = threats_of({}, both);
        const double left = threats.to_between(p, to_left, shoulders, straight_on);
        if (gap > 1)
            EXPECT_NEAR(left, gap / 2 - 0.4, 0.051);
        else
            EXPECT_EQ(left, world::infinity) << "no room between them";
    }
}

TEST(Threats, ComeFromWhoReversesAsWell) {
    const double rear = -world::vehicle_models()[0].rear_overhang;
    EXPECT_TRUE(one_car(-3).way_out({rear - 2, 0.1}, shoulders));
    EXPECT_FALSE(one_car(-3).way_out({front() + 2, 0.1}, shoulders));
}

}  // namespace
}  // namespace reprise::walkers
