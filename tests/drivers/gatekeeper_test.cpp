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

/// junction_road, and `between` metres behind its junction another one of 10 m, crossed as well.
world::TownT two_junctions(double between) {
    using world::LaneKind;
    world::TownT town = test::junction_road(false);
    const double from = 210 + between;
    town.lanes[2] = test::make_lane("between", test::Turtle(210, 0, 0).ahead(between));
    town.lanes.push_back(
        test::make_lane(":2", test::Turtle(from, 0, 0).ahead(10), 13.89, LaneKind::internal));
    town.lanes.push_back(test::make_lane("east", test::Turtle(from + 10, 0, 0).ahead(200)));
    town.lanes.push_back(
        test::make_lane("south_2", test::Turtle(from + 5, -205, north).ahead(200)));
    town.lanes.push_back(test::make_lane(
        ":3", test::Turtle(from + 5, -5, north).ahead(10), 13.89, LaneKind::internal));
    town.lanes.push_back(test::make_lane("north_2", test::Turtle(from + 5, 5, north).ahead(200)));
    town.junctions.resize(2);
    town.lanes[2].junction = town.lanes[8].junction = 1;
    town.lanes[2].links = {test::make_link(7, 6, world::Turn::straight)};
    town.lanes[6].links = {test::make_link(7, world::none, world::Turn::straight)};
    town.lanes[8].links = {test::make_link(10, 9, world::Turn::straight, true)};
    town.lanes[9].links = {test::make_link(10, world::none, world::Turn::straight)};
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

/// Both come to the eastern lane; a bend of 5 m is no place to drive 12 m/s on.
TEST(Gatekeeper, WaitsForWhoMustSlowDownForHisTurn) {
    world::TownT bent = test::junction_road(true);
    bent.lanes[4] = test::make_lane(
        ":1", test::Turtle(205, -5, north).turn(-north, 5), 13.89, world::LaneKind::internal);
    bent.lanes[3].links = {test::make_link(2, 4, world::Turn::right, false)};
    bent.lanes[4].links = {test::make_link(2, world::none, world::Turn::right)};
    world::TownT joining = bent;
    joining.lanes[4] = test::make_lane(
        ":1", test::Turtle(205, -5, north * 0.5).ahead(7), 13.89, world::LaneKind::internal);
    // 20 m at 12 m/s, and the rest at no more than 3.2 m/s: it is there when we are, in 4 s.
    const world::SealedTick tick = tick_of({crossing_car(20, 12)});
    EXPECT_LT(Approach(bent).allowed(40, 11, tick), 0);
    EXPECT_EQ(Approach(joining).allowed(40, 11, tick), world::infinity);
    // Who is in the bend already does not hurry, either.
    world::CarState in_it = crossing_car(0, 3);
    in_it.mutate_lane(4);
    in_it.mutate_lane_s(1);
    EXPECT_LT(Approach(bent).allowed(50, 11, tick_of({in_it})), world::infinity);
}

TEST(Gatekeeper, StopsAtRedWithTheBrakingOfTheTextbook) {
    Approach approach(false, 0);
    const double allowed = approach.allowed(31, 10, tick_of({}, {world::SignalColor::red}));
    // v^2 / 2d brings the car to its place before the line; the driver's curve brakes about so.
    EXPECT_EQ(allowed, stop_acceleration(30, 10, 2, approach.style));
    EXPECT_GT(allowed, -100.0 / (2 * 30) - 0.5);
    EXPECT_EQ(approach.allowed(31, 10, tick_of({}, {world::SignalColor::green})), world::infinity);
}

/// junction_road, where who comes north may turn left into the street that we come from as well.
world::TownT turning_road() {
    world::TownT town = test::junction_road(false);
    const test::Turtle turn = test::Turtle(205, -5, north).ahead(3.5).turn(north, 5);
    town.lanes.push_back(test::make_lane(":2", turn, 8, world::LaneKind::internal));
    town.lanes.push_back(test::make_lane("back", test::Turtle(200, 3.5, 2 * north).ahead(200)));
    town.lanes[3].links.push_back(test::make_link(7, 6, world::Turn::left, true));
    town.lanes[6].links = {test::make_link(7, world::none, world::Turn::left)};
    town.lanes[0].links = {test::make_link(2, 1, world::Turn::straight, false, 0)};
    return town;
}

TEST(Gatekeeper, StopsFartherFromTheLineWhileABusTurnsInBeside) {
    const auto allowed = [](const char* model, std::uint32_t lane, double distance, double speed) {
        world::CarState other = crossing_car(-2, 3);
        other.mutate_model(world::find_vehicle_model(model).value());
        other.mutate_lane(lane);
        return Approach(turning_road())
            .allowed(distance, speed, tick_of({other}, {world::SignalColor::red}));
    };
    const DrivingStyle style;
    EXPECT_EQ(allowed("bus", 6, 31, 8), stop_acceleration(31 - 9, 8, 2, style));
    EXPECT_EQ(allowed("sedan", 6, 31, 8), stop_acceleration(31 - to_stop_at, 8, 2, style));
    EXPECT_EQ(allowed("bus", 4, 31, 8), stop_acceleration(31 - to_stop_at, 8, 2, style))
        << "goes straight on";
    // Too late for that: as soon as it is comfortable. Who stands there already stays.
    EXPECT_EQ(allowed("bus", 6, 12, 5), stop_acceleration(5 * 5 / 4.0, 5, 2, style));
    EXPECT_LT(allowed("bus", 6, 5, 0), 0);
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

TEST(Gatekeeper, StandsWhereTwoRoadsJoinAndNobodyCrosses) {
    world::TownT joint = test::junction_road(false);
    joint.lanes[3].links.clear();  // nobody comes across
    Approach approach(joint);
    approach.overlaps = {{212, 0, 5}};
    EXPECT_EQ(approach.allowed(20, 10, tick_of({})), world::infinity);

    // Unless it is people who cross.
    world::LaneT crossing = joint.lanes[4];
    crossing.kind = world::LaneKind::crossing;
    crossing.junction = 0;
    joint.lanes.push_back(crossing);
    Approach walked(joint);
    walked.overlaps = {{212, 0, 5}};
    EXPECT_LT(walked.allowed(20, 10, tick_of({})), 0);
}

TEST(Gatekeeper, KeepsARowOfJunctionsFreeThatHasNoRoomInBetween) {
    for (const double between : {2.0, 12.0}) {
        Approach approach(two_junctions(between));
        approach.overlaps = {{218 + between, 0, 5}};  // stands in the second one
        const double allowed = approach.allowed(1.5, 0, tick_of({}));
        EXPECT_EQ(allowed < 1, between < 5) << between << " m";
    }
    Approach approach(two_junctions(2));
    approach.overlaps = {{220 + 8 + 5, 0, 5}};  // a car's length behind the second
    EXPECT_EQ(approach.allowed(1.5, 0, tick_of({})), world::infinity);
}

TEST(Gatekeeper, EntersARowOfJunctionsAfterThreeQuartersOfAMinuteThatOnlyItsEndIsNotFree) {
    Approach approach(two_junctions(2));
    approach.overlaps = {{220, 0, 5}};
    for (int tick = 0; tick * step < 44.9; ++tick)
        ASSERT_LT(approach.allowed(1.5, 0, tick_of({})), 1) << tick * step << " s";
    double allowed = 0;
    for (int tick = 0; tick < 5; ++tick)
        allowed = approach.allowed(1.5, 0, tick_of({}));
    EXPECT_GT(allowed, 1) << "up to the second one";
}

/// Behind a crossing with many people a queue creeps, and others fill each gap before us.
TEST(Gatekeeper, EntersARowOfJunctionsAlsoWhereTheFirstIsSeldomFree) {
    Approach approach(two_junctions(2));
    for (int tick = 0; tick * step < 44.9; ++tick) {
        const bool is_first_free = tick % 100 == 0;
        approach.overlaps = {{is_first_free ? 220.0 : 208.0, 0, 5}};
        ASSERT_LT(approach.allowed(1.5, 0, tick_of({})), 1) << tick * step << " s";
    }
    approach.overlaps = {{208, 0, 5}};
    for (int tick = 0; tick < 100; ++tick)
        ASSERT_LT(approach.allowed(1.5, 0, tick_of({})), 1);
    approach.overlaps = {{220, 0, 5}};
    EXPECT_GT(approach.allowed(1.5, 0, tick_of({})), 1);
}

/// One of them always stands there, and waits for nobody.
TEST(Gatekeeper,
     WhoStandAtTheOtherLinesKeepItWaitingForEightSecondsWhoDriveOrStandInsideForLonger) {
    const auto waits = [](const world::CarState& car, int ticks) {
        Approach approach(false);
        approach.overlaps = {{204, static_cast<double>(car.speed()), car.id()}};
        double allowed = 0;
        for (int tick = 0; tick < ticks; ++tick)
            allowed = approach.allowed(1.5, 0, tick_of({car}));
        return allowed < 1;
    };
    EXPECT_TRUE(waits(crossing_car(0.5, 0), 160));
    EXPECT_FALSE(waits(crossing_car(0.5, 0), 163));
    EXPECT_TRUE(waits(crossing_car(0.5, 1), 163)) << "begins to drive";
    EXPECT_TRUE(waits(crossing_car(20, 0), 163)) << "stands elsewhere";
    world::CarState inside = crossing_car(0.5, 0);
    inside.mutate_lane(4);
    EXPECT_TRUE(waits(inside, 163));
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
