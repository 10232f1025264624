#include "drivers/gatekeeper.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/drivers/junction_road.h"
#include "tests/support/worlds.h"
#include "world/units.h"

namespace reprise::drivers {
namespace {

constexpr double step = 0.05;     // [s]
constexpr double to_stop_at = 1;  // [m] before the lane's end, see gatekeeper.cpp
constexpr double north = std::numbers::pi / 2;

/// A gatekeeper on the eastbound lane of junction_road.
class Approach {
  public:
    explicit Approach(bool yields, std::uint32_t signal = world::none)
        : Approach(with_signal(test::junction_road(yields), signal)) {}

    explicit Approach(world::TownT town)
        : town_(std::move(town)),
          graph_(town_),
          way_(graph_, 7, 1),
          gatekeeper(town_) {
        way_.restart({0}, {});
        way_.extend(0, 300);
    }

    /// What it allows a sedan whose front bumper is `distance` before the junction. [m/s^2]
    double allowed(double distance, double speed, const world::SealedTick& tick) {
        Ego ego = ego_of(test::vehicle_at(1, 0, 0, 0, speed));
        ego.rear_axle_s = 200 - distance - (ego.front_s() - ego.rear_axle_s);
        ego.position.x() = ego.rear_axle_s;
        return gatekeeper.decide(tick.view(), ego, way_, overlaps, style, step);
    }

  private:
    static world::TownT with_signal(world::TownT town, std::uint32_t signal) {
        const world::Link& link = town.lanes[0].links[0];
        town.lanes[0].links = {
            test::make_link(link.to(), link.via(), link.turn(), link.yields(), signal)};
        return town;
    }

    world::TownT town_;
    LaneGraph graph_;
    Way way_;

  public:
    Gatekeeper gatekeeper;
    DrivingStyle style;
    std::vector<Overlap> overlaps;
};

/// A car on the crossing lane, its front bumper `distance` before the junction.
world::CarState crossing_car(double distance, double speed) {
    const world::VehicleModel& sedan = world::vehicle_models()[0];
    const double front = -5 - distance;
    return {world::Vec3(205, front - (sedan.length - sedan.rear_overhang), 0),
            static_cast<float>(north),
            0,
            static_cast<float>(speed),
            static_cast<float>(200 - distance),
            1'000'000,
            3,
            0,
            0,
            0};
}

world::SealedTick tick_of(std::vector<world::CarState> cars,
                          std::vector<world::SignalColor> signals = {}) {
    return test::tick_with({}, std::move(cars), std::move(signals));
}

/// junction_road with a stop sign at the end of the eastbound lane.
world::TownT signed_road(bool yields) {
    world::TownT town = test::junction_road(yields);
    world::Prop sign;
    sign.mutate_kind(world::PropKind::stop_sign);
    sign.mutable_position() = world::Vec3(199, -3, 0);
    town.props.push_back(sign);
    return town;
}

}  // namespace

TEST(Gatekeeper, LetsPassWhereTheOthersGiveWay) {
    Approach approach(false);
    EXPECT_EQ(approach.allowed(20, 10, tick_of({crossing_car(20, 10)})), world::infinity);
}

TEST(Gatekeeper, GivesWayToACarThatIsThereAtTheSameTime) {
    Approach approach(true);
    // Both 20 m away at 10 m/s: they would meet in 2 s.
    const double least = approach.allowed(20, 10, tick_of({crossing_car(20, 10)}));
    EXPECT_EQ(least, stop_acceleration(20 - to_stop_at, 10, 2, approach.style));
    EXPECT_LT(least, 0);
}

TEST(Gatekeeper, GoesWhenTheOtherIsFarFromItsConflictPoint) {
    Approach approach(true);
    // It needs 10 s for 100 m; we are across after (20 + 10 + 5) m / 10 m/s.
    EXPECT_EQ(approach.allowed(20, 10, tick_of({crossing_car(100, 10)})), world::infinity);
}

TEST(Gatekeeper, StopsAtRedWithTheBrakingOfTheTextbook) {
    Approach approach(false, 0);
    const double allowed = approach.allowed(31, 10, tick_of({}, {world::SignalColor::red}));
    // v^2 / 2d brings the car to its place before the line; the driver's curve brakes about so.
    EXPECT_EQ(allowed, stop_acceleration(30, 10, 2, approach.style));
    EXPECT_GT(allowed, -100.0 / (2 * 30) - 0.5);
    EXPECT_EQ(approach.allowed(31, 10, tick_of({}, {world::SignalColor::green})), world::infinity);
}

TEST(Gatekeeper, DrivesThroughYellowWhereStoppingTakesMoreThanItLikes) {
    // 10 m/s within 15 m - 1 m: 3.6 m/s^2, more than the 3.5 of comfortable stops at yellow; from
    // 16 m it is 3.3.
    const world::SealedTick yellow = tick_of({}, {world::SignalColor::yellow});
    EXPECT_EQ(Approach(false, 0).allowed(15, 10, yellow), world::infinity);
    EXPECT_LT(Approach(false, 0).allowed(16, 10, yellow), 0);
}

TEST(Gatekeeper, KeepsTheJunctionFreeWhenThereIsNoRoomBehindIt) {
    Approach approach(false);
    approach.overlaps = {{212, 0, 5}};  // stands 2 m behind the junction
    EXPECT_LT(approach.allowed(20, 10, tick_of({})), 0);
    approach.overlaps = {{212, 10, 5}};  // drives on
    EXPECT_EQ(approach.allowed(20, 10, tick_of({})), world::infinity);
}

TEST(Gatekeeper, StopsAtAStopSignThoughNobodyIsThereAndGoesOnOnceItStood) {
    Approach approach(true, 0);
    const world::SealedTick sign = tick_of({}, {world::SignalColor::stop});
    EXPECT_EQ(approach.allowed(31, 10, sign), stop_acceleration(30, 10, 2, approach.style));
    EXPECT_LT(approach.allowed(6, 4, sign), 0);
    EXPECT_LT(approach.allowed(1.5, 1.5, sign), 0) << "rolling is not standing";
    EXPECT_LT(approach.allowed(6, 0, sign), world::infinity) << "it stood too far before the line";
    EXPECT_EQ(approach.allowed(1, 0, sign), world::infinity);
    EXPECT_EQ(approach.allowed(0.5, 1, sign), world::infinity) << "once is enough";
}

TEST(Gatekeeper, HaltsOnceWhereASignStandsBesideALaneThatGivesWay) {
    Approach approach(signed_road(true));
    const world::SealedTick nobody = tick_of({});
    EXPECT_EQ(approach.allowed(31, 10, nobody), stop_acceleration(30, 10, 2, approach.style));
    EXPECT_LT(approach.allowed(1.5, 1.5, nobody), 0) << "rolling is not standing";
    EXPECT_EQ(approach.allowed(1, 0, nobody), world::infinity);
    Approach ignores(signed_road(true));
    ignores.gatekeeper.ignore_lights(true);
    EXPECT_EQ(ignores.allowed(31, 10, nobody), world::infinity);
    EXPECT_EQ(Approach(signed_road(false)).allowed(31, 10, nobody), world::infinity)
        << "the sign is for another road";
}

TEST(Gatekeeper, CreepsOnAfterTwelveSecondsOfGivingWay) {
    Approach approach(true);
    const world::SealedTick busy = tick_of({crossing_car(3, 2)});
    int ticks = 0;
    while (approach.allowed(2, 0, busy) <= 0.5 && ticks < 1000)
        ++ticks;
    EXPECT_NEAR(ticks * step, 12, 2 * step);
}

}  // namespace reprise::drivers
