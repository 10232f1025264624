// How far it still is, against ways that are measured without the planner.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/models/catalogue.h"

namespace reprise::test {
namespace {

double goal_of(const KeptTick& tick, std::uint32_t id = 1) {
    return world::find(tick.recorded().view.measurements(), id)->goal_distance();
}

double front_of(const world::VehicleState& vehicle) {
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    return model.length - model.rear_overhang;
}

/// On a straight road it is what a ruler says: along x from the front bumper.
TEST(GoalDistance, IsWhatIsLeftOfTheRoad) {
    const auto ticks = run(on_straight_lanes(
        "local ego = spawn{ model = 'sedan', lane = 'main_1', s = 20, speed = 10 }\n"
        "spawn{ model = 'sedan', lane = 'main_1', s = 220 }\n"
        "wait_ticks(3)\nego:route_to{ lane = 'main_1', s = 120 }\nwait(60)",
        14));
    double least = 1e9;
    double from_x = 0;
    double from_s = 0;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const world::TickView view = ticks[i].recorded().view;
        const world::VehicleState& ego = *world::find(view.vehicles(), 1);
        const world::Measurement& measured = *world::find(view.measurements(), 1);
        EXPECT_EQ(goal_of(ticks[i], 2), -1) << "nobody told it where to";
        EXPECT_GT(measured.speed_limit(), 1);
        if (i < 3) {
            EXPECT_EQ(measured.goal_distance(), -1) << i;
            from_x = ego.position().x();
            from_s = measured.lane_s();
            continue;
        }
        const double driven = std::abs(ego.position().x() - from_x);
        const double expected = 120 - from_s - driven - front_of(ego);
        EXPECT_NEAR(measured.goal_distance(), std::max(0.0, expected), 0.05) << "tick " << i + 1;
        least = std::min(least, measured.goal_distance());
    }
    EXPECT_EQ(least, 0) << "it arrived";
}

/// Through a town it falls by what the odometer says, corners included.
TEST(GoalDistance, FallsByWhatIsDriven) {
    const auto ticks =
        run(in_town("town2",
                    "local lane = pick_lane{ length = 60 }\n"
                    "local ego = spawn{ model = 'sedan', lane = lane, s = 10 }\n"
                    "local to = lane_next(lane, 'left') or lane_next(lane, 'right')\n"
                    "ego:route_to{ lane = to, s = 30 }\nwait(600)",
                    40));
    double way = -1;  // until it is told
    for (const KeptTick& tick : ticks) {
        const double left = goal_of(tick);
        if (left == 0)
            break;
        if (way < 0 && left > 0)
            way = left + world::find(tick.recorded().view.vehicles(), 1)->odometer();
        if (way < 0)
            continue;
        const double driven = world::find(tick.recorded().view.vehicles(), 1)->odometer();
        ASSERT_NEAR(left + driven, way, 2.5) << "a corner is cut by a metre or two";
    }
    EXPECT_GT(way, 40);
    EXPECT_EQ(goal_of(ticks.back()), 0);
}

}  // namespace
}  // namespace reprise::test
