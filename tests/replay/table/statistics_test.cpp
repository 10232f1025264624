#include "replay/table/statistics.h"

#include <gmock/gmock.h>

#include "tests/replay/synthetic_run.h"

namespace reprise::replay {
namespace {

/// Speeds and decelerations as told, tick by tick; one collision in the third.
TraceStatistics counted(const std::vector<double>& speeds,
                        const std::vector<double>& decelerations) {
    test::Folder folder;
    test::SyntheticRun run;
    run.ticks = speeds.size();
    run.change = [&](world::TickDraft& draft) {
        const std::size_t i = draft.tick.index - 1;
        for (world::VehicleState& vehicle : draft.tick.vehicles)
            vehicle.mutate_odometer(100 + 2.5 * static_cast<double>(i));
        draft.tick.measurements.clear();
        for (const world::VehicleState& vehicle : draft.tick.vehicles) {
            world::Measurement measurement;
            measurement.mutate_actor(vehicle.id());
            measurement.mutate_speed(speeds[i]);
            measurement.mutate_acceleration(-decelerations[i]);
            measurement.mutate_gap_ahead(50 - static_cast<double>(i));
            draft.tick.measurements.push_back(measurement);
        }
        if (i == 2) {
            draft.tick.events.emplace_back();
            draft.tick.events.back().kind = world::EventKind::collision;
            draft.tick.events.back().actor = draft.tick.vehicles.front().id();
        }
    };
    test::write_trace(folder / "a.mcap", run);
    TraceReader trace(folder / "a.mcap");
    return statistics(trace);
}

TEST(Statistics, CountDistanceSpeedAndStanding) {
    const auto all = counted({0, 0.05, 4, -8}, {0, 0, 0, 0});
    ASSERT_EQ(all.vehicles.size(), 1U);
    const VehicleStatistics& ego = all.vehicles.front();
    EXPECT_EQ(all.ticks, 4U);
    EXPECT_DOUBLE_EQ(ego.distance, 7.5);
    EXPECT_DOUBLE_EQ(ego.mean_speed, 12.05 / 4);
    EXPECT_EQ(ego.max_speed, 8);
    EXPECT_EQ(ego.standing, 2U);
    EXPECT_EQ(ego.least_gap, 47) << "while it drove";
    EXPECT_EQ(ego.collisions, 1U);
}

/// A brake that wavers around the limit is one brake.
TEST(Statistics, AHardBrakeEndsBelowHalfOfItsLimit) {
    const auto all = counted(std::vector<double>(8, 10.0), {0, 4, 3, 5, 1.9, 3.9, 4.1, 0});
    EXPECT_EQ(all.vehicles.front().hard_brakes, 2U);
    EXPECT_EQ(all.vehicles.front().max_deceleration, 5);
}

TEST(Statistics, BytesAreThoseOfTheMessages) {
    const auto all = counted({1, 1, 1}, {0, 0, 0});
    EXPECT_GT(all.traffic_bytes, 0U);
    test::Folder folder;
    test::write_trace(folder / "a.mcap");
    TraceReader trace(folder / "a.mcap");
    const auto whole = statistics(trace);
    EXPECT_EQ(whole.tick_bytes + whole.traffic_bytes, trace.message_bytes());
    EXPECT_EQ(whole.cars.most, trace.tick(1).view.cars().size());
}

TEST(Statistics, OfAnEmptyTraceAreZero) {
    test::Folder folder;
    test::write_trace(folder / "a.mcap", {.ticks = 0});
    TraceReader trace(folder / "a.mcap");
    const auto all = statistics(trace);
    EXPECT_EQ(all.ticks, 0U);
    EXPECT_TRUE(all.vehicles.empty());
    EXPECT_EQ(all.cars.mean, 0);
}

}  // namespace
}  // namespace reprise::replay
