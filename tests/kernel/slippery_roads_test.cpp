// Whole runs on snow and ice: the built-in drivers go as the road allows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "drivers/control/pedals.h"
#include "tests/kernel/whole_run.h"
#include "world/models/catalogue.h"

namespace reprise::test {

namespace {

constexpr double wet = 0.68;
constexpr double snow = 0.33;
constexpr double ice = 0.09;

struct Outcome {
    double at_end = 0;  ///< [m/s]
    double gap = 0;     ///< [m] between the bumpers, at the end
    bool touches = false;
};

/// From 2 m/s, with a van that stands 200 m ahead.
Outcome drive_up_to_a_van(const std::string& pilot, double friction) {
    world::Recording recording = on_straight_lanes(fmt::format(R"(
            spawn{{ model = 'sedan', pilot = '{}', lane = 'main_1', s = 100, speed = 2 }}
            spawn{{ model = 'van', driver = 'parked', lane = 'main_1', s = 300 }}
            wait(100))",
                                                               pilot),
                                                   95);
    recording.episode.road_friction = friction;
    Outcome outcome;
    for (const KeptTick& tick : run(recording)) {
        const world::TickView view = tick.recorded().view;
        for (const world::Event* event : *view.tick->events())
            outcome.touches |= event->kind() == world::EventKind::collision;
        if (const world::Measurement* measured = world::find(view.measurements(), 1)) {
            outcome.at_end = measured->speed();
            outcome.gap = measured->gap_ahead();
        }
    }
    return outcome;
}

world::CarModel car(const char* model) {
    return world::car_model(world::vehicle_models()[*world::find_vehicle_model(model)]);
}

}  // namespace

TEST(SlipperyRoads, DriversStopBeforeWhatStands) {
    for (const char* pilot : {"idm", "pid"})
        for (const double friction : {1.0, wet, snow, 0.2, ice}) {
            const Outcome outcome = drive_up_to_a_van(pilot, friction);
            EXPECT_FALSE(outcome.touches) << pilot << " on " << friction;
            EXPECT_LT(outcome.at_end, 0.1) << pilot << " on " << friction;
            EXPECT_GT(outcome.gap, 1) << pilot << " on " << friction;
            EXPECT_LT(outcome.gap, 8) << pilot << " on " << friction;
        }
}

/// A golden of a wet road must not differ from what it was.
TEST(SlipperyRoads, WhatHoldsWellEnoughIsDrivenAsEver) {
    for (const char* model : {"sedan", "lorry", "bus", "motorcycle"})
        EXPECT_EQ(drivers::style_on(wet, 0.08, car(model)).share, 1) << model;
    EXPECT_EQ(drivers::style_on(snow, 0, car("sedan")).share, 1);
    EXPECT_LT(drivers::style_on(snow, 0.08, car("sedan")).share, 0.9);
    EXPECT_LT(drivers::style_on(ice, 0, car("sedan")).share, 0.3);
}

}  // namespace reprise::test
