#include "traffic/cars/decisions.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <libsumo/libsumo.h>

#include "tests/support/towns.h"
#include "tests/traffic/stage.h"
#include "traffic/cars/fleet.h"
#include "traffic/sumo.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::own_town;
using test::Stage;

constexpr double each = 0.05, rolling = 0.1, standing = 0.25;  // [s]

/// [s] between two decisions of the car.
double interval_of(std::uint32_t id) {
    return libsumo::Vehicle::getActionStepLength(sumo_id(id));
}

TEST(Decisions, WhoStandsDecidesFourTimesASecondAndWhoRollsTen) {
    Stage stage(own_town("town1"), 60);
    int rolled = 0, stood = 0;
    for (int i = 0; i < 600; ++i) {
        stage.step();
        for (const std::string& name : libsumo::Vehicle::getIDList()) {
            const double every = libsumo::Vehicle::getActionStepLength(name);
            const double speed = libsumo::Vehicle::getSpeed(name);
            rolled += every == rolling;
            stood += every == standing;
            ASSERT_TRUE(every == each || every == rolling || every == standing) << every;
            // Who stood may have decided to drive in this step.
            EXPECT_TRUE(every != standing || speed < 0.2) << name << " drives " << speed;
            EXPECT_TRUE(every != rolling || speed > 2.5) << name << " drives " << speed;
        }
    }
    EXPECT_GT(rolled, 60 * 600 / 5);
    EXPECT_GT(stood, 60 * 600 / 20);
}

/// A tick without a decision would carry it over a line that it meant to stop at, and onto what its
/// route does not have any more.
TEST(Decisions, WhoComesToTheEndOfItsLaneDecidesInEachTick) {
    const test::Loaded& town1 = own_town("town1");
    Stage stage(town1, 60);
    for (int i = 0; i < 600; ++i) {
        // Of the last step, as it is in the next one.
        for (const std::string& name : libsumo::Vehicle::getIDList()) {
            if (libsumo::Vehicle::getActionStepLength(name) != rolling)
                continue;
            const std::string lane = libsumo::Vehicle::getLaneID(name);
            EXPECT_LT(libsumo::Vehicle::getLanePosition(name), libsumo::Lane::getLength(lane) - 2)
                << name;
        }
        stage.step();
    }
}

TEST(Decisions, WhoIsNewDrivesAsFastAsHeCame) {
    Stage stage(own_town("town2"), 60);
    for (int i = 0; i < 3; ++i) {
        stage.step();
        for (const world::CarState& car : stage.draft().traffic.cars)
            EXPECT_LT(std::abs(car.acceleration()), 10.0F) << car.id();
    }
}

/// Somebody steps before a car at the distance in which it can just stop, in both kinds of ticks.
TEST(Decisions, WhoIsSurprisedStopsAsWellAsHisBrakesAllow) {
    const test::Loaded& town1 = own_town("town1");
    for (const int wait : {60, 61, 62, 63}) {
        Stage stage(town1, 30);
        stage.steps(wait);
        const world::CarState* chosen = nullptr;
        for (const world::CarState& car : stage.draft().traffic.cars) {
            const world::LaneT& lane = town1.town.lanes[car.lane()];
            if (lane.kind == world::LaneKind::driving && car.speed() > 7 &&
                static_cast<double>(car.lane_s()) + 40 < lane.length)
                chosen = &car;
        }
        ASSERT_NE(chosen, nullptr) << wait;
        const std::uint32_t id = chosen->id();
        const std::uint32_t on = chosen->lane();
        const double speed = static_cast<double>(chosen->speed());
        const double hardest = emergency_braking(chosen->model());
        // Seen in the tick after the next, braked for in that one.
        const double way = speed * speed / (2 * hardest) + 2 * each * speed + 1.3;
        const double s = static_cast<double>(chosen->lane_s()) + way;
        const world::LanePoint at = world::point_at(town1.town.lanes[on], s);
        stage.walkers = {
            {world::to_vec3(at.position), static_cast<float>(at.yaw), 0, 0, 77, 0, false, 0, 0}};
        double farthest = 0;
        for (int i = 0; i < 80 && stage.car(id) != nullptr && stage.car(id)->lane() == on; ++i) {
            stage.step();
            EXPECT_TRUE(i <= 3 || interval_of(id) == each) << i;
            farthest = std::max(farthest, static_cast<double>(stage.car(id)->lane_s()));
        }
        EXPECT_LT(farthest, s - 0.2) << "touched, of " << speed << " m/s, after " << wait;
        EXPECT_LT(stage.car(id)->speed(), 0.1F);
    }
}

}  // namespace
}  // namespace reprise::traffic
