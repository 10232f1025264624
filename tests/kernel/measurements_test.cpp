#include "kernel/measurements.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// What is measured of the first vehicle.
world::Measurement measured(const std::vector<world::VehicleState>& vehicles,
                            const std::vector<world::CarState>& cars = {}) {
    const world::TownT town = test::straight_road(400, 2);
    const world::LaneMap lanes(town);
    world::TickDraft genesis;
    const world::SealedTick last = world::seal(genesis, {});
    world::TickDraft next;
    next.tick.vehicles = vehicles;
    next.traffic.cars = cars;
    measure(town, lanes, 0.05, {}, last.view(), next);
    return next.tick.measurements.at(0);
}

const world::VehicleModel& sedan() {
    return world::vehicle_models()[0];
}

}  // namespace

TEST(FootprintShares, OfWhoTremblesAreThoseFromBeforeAndOfWhoRollsAreNew) {
    const world::TownT town = test::straight_road(400, 2);
    const world::LaneMap lanes(town);
    world::TickDraft genesis;
    const world::SealedTick nothing = world::seal(genesis, {});
    world::TickDraft first;
    first.tick.vehicles = {test::vehicle_at(1, 100, 0.3), test::vehicle_at(2, 200, 0.3)};
    measure(town, lanes, 0.05, {}, nothing.view(), first);
    // What nobody would measure: so it is seen whether it stays.
    first.tick.measurements[0].mutate_on_opposite_lane(0.123);
    first.tick.measurements[1].mutate_on_opposite_lane(0.123);
    const world::SealedTick last = world::seal(first, {});
    world::TickDraft next;
    next.tick.vehicles = {test::vehicle_at(1, 100 + 1e-12, 0.3), test::vehicle_at(2, 200, 0.301)};
    measure(town, lanes, 0.05, {}, last.view(), next);
    EXPECT_EQ(next.tick.measurements[0].on_opposite_lane(), 0.123);
    EXPECT_NEAR(next.tick.measurements[1].on_opposite_lane(),
                measured({next.tick.vehicles[1]}).on_opposite_lane(),
                0);
    EXPECT_GT(next.tick.measurements[1].on_opposite_lane(), 0.3);
}

TEST(GapAhead, IsFromBumperToBumper) {
    // Rear axles 30 m apart: between the bumpers it is a car's length less, wherever the axle is.
    const double gap = 30 - sedan().length;
    EXPECT_NEAR(
        measured({test::vehicle_at(1, 100, -1.75)}, {test::car_at(7, 130, -1.75)}).gap_ahead(),
        gap,
        1e-6);
    EXPECT_NEAR(
        measured({test::vehicle_at(1, 100, -1.75), test::vehicle_at(2, 130, -1.75)}).gap_ahead(),
        gap,
        1e-6);
    // The same two, turned by a quarter.
    EXPECT_NEAR(
        measured({test::vehicle_at(1, 100, 0, quarter), test::vehicle_at(2, 100, 30, quarter)})
            .gap_ahead(),
        gap,
        1e-6);
}

TEST(GapAhead, OfACarAcrossTheWayIsToItsSide) {
    const auto car = test::car_at(7, 130, -1.75 - 1, quarter);
    EXPECT_NEAR(measured({test::vehicle_at(1, 100, -1.75)}, {car}).gap_ahead(),
                30 - sedan().width / 2 - (sedan().length - sedan().rear_overhang),
                1e-5);
}

TEST(GapAhead, IsHundredWhereNobodyIsInTheCorridor) {
    const auto ego = test::vehicle_at(1, 200, -1.75);
    EXPECT_EQ(measured({ego}).gap_ahead(), 100);
    EXPECT_EQ(measured({ego}, {test::car_at(7, 170, -1.75)}).gap_ahead(), 100) << "behind";
    EXPECT_EQ(measured({ego}, {test::car_at(7, 220, -5.25)}).gap_ahead(), 100) << "beside";
    EXPECT_EQ(measured({ego}, {test::car_at(7, 310, -1.75)}).gap_ahead(), 100) << "too far";
}

TEST(GapAhead, IsNeverNegative) {
    EXPECT_EQ(
        measured({test::vehicle_at(1, 100, -1.75)}, {test::car_at(7, 102, -1.75)}).gap_ahead(), 0);
}

TEST(LaneS, CountsFromTheStartOfTheLaneThatTheVehicleDrives) {
    const world::TownT town = test::straight_road(400, 2);
    const world::Measurement east = measured({test::vehicle_at(1, 120, -1.25)});
    EXPECT_EQ(town.lanes.at(east.lane()).name, "east_2");
    EXPECT_NEAR(east.lane_s(), 120, 1e-6);
    EXPECT_NEAR(east.lane_t(), 0.5, 1e-6) << "left of the centre line";
    const world::Measurement west = measured({test::vehicle_at(1, 120, 1.25, 2 * quarter)});
    EXPECT_EQ(town.lanes.at(west.lane()).name, "west_2");
    EXPECT_NEAR(west.lane_s(), 400 - 120, 1e-6);
}

}  // namespace reprise::kernel
