#include "render/optics/events.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/render/frames.h"

namespace reprise {

namespace {

using world::SensorKind;

world::SensorSpec event_camera(std::vector<world::AttributeValue> attributes = {}) {
    world::SensorSpec spec = test::camera(SensorKind::dvs, {100, -12, 1.2});
    spec.yaw = M_PI / 2;
    spec.attributes = std::move(attributes);
    return spec;
}

/// Of one pixel that goes from one logarithm of light to another.
world::SensorFrame events(const std::vector<float>& logs,
                          std::vector<world::AttributeValue> attributes = {}) {
    world::SensorSpec spec = event_camera(std::move(attributes));
    world::SensorFrame frame;
    frame.kind = SensorKind::dvs;
    frame.width = frame.height = 1;
    frame.channels = 2;
    std::vector<render::LogPicture> pictures;
    for (const float log : logs)
        pictures.push_back({static_cast<std::int64_t>(pictures.size()) * 1'000'000, {log}});
    render::find_events(spec, pictures, frame);
    return frame;
}

int sum(const world::SensorFrame& frame) {
    int total = 0;
    for (const world::PixelEvent& event : frame.events)
        total += event.rising ? 1 : -1;
    return total;
}

world::SensorFrame seen(render::Sensors& sensors,
                        double last_x,
                        double x,
                        std::uint64_t index = 2) {
    const world::SealedTick last =
        test::tick_with({}, {test::car_at(7, last_x, -1.75)}, {}, index - 1);
    const world::SealedTick now = test::tick_with({}, {test::car_at(7, x, -1.75)}, {}, index);
    render::Neighbours neighbours;
    neighbours.last = render::Neighbour{last.view(), {}};
    // Clouds move, and their shadows.
    world::Weather clear = test::noon();
    clear.mutate_wind_speed(0);
    return sensors.observe(now.view(), {event_camera()}, clear, neighbours)[0];
}

}  // namespace

TEST(Events, OfOneStepComeAThresholdApart) {
    const world::SensorFrame frame = events({0, 3.0F});
    ASSERT_EQ(frame.events.size(), 10U) << "3.0 over 0.3";
    for (std::size_t i = 1; i < frame.events.size(); ++i)
        EXPECT_NEAR(
            static_cast<double>(frame.events[i].time_ns - frame.events[i - 1].time_ns), 100'000, 2);
    EXPECT_EQ(frame.data, (std::vector<std::uint8_t>{10, 0}));
    EXPECT_EQ(events({3.0F, 0}).data, (std::vector<std::uint8_t>{0, 10}));
    EXPECT_EQ(events({0, 3.0F}, {{"positive_threshold", 0.6}}).events.size(), 5U);
    EXPECT_EQ(events({0, 3.0F}, {{"refractory_period_ns", 150'000}}).events.size(), 5U);
}

TEST(Events, OfSlowChangesAddUpOverTicksThoughNothingIsRemembered) {
    int total = 0;
    for (int tick = 0; tick < 100; ++tick)
        total +=
            sum(events({0.02F * static_cast<float>(tick), 0.02F * static_cast<float>(tick + 1)}));
    EXPECT_EQ(total, sum(events({0, 2.0F})));
    EXPECT_GE(total, 6);
}

TEST(Events, AreWhereSomethingMoves) {
    render::Sensors sensors(test::straight_road(400));
    EXPECT_TRUE(seen(sensors, 99, 99).events.empty());
    const world::SensorFrame frame = seen(sensors, 98, 99);
    ASSERT_GT(frame.events.size(), 50U);
    std::size_t counted = 0;
    for (const std::uint8_t count : frame.data)
        counted += count;
    EXPECT_EQ(counted, frame.events.size());
    for (const world::PixelEvent& event : frame.events) {
        EXPECT_GT(event.y, 40) << "the car is low in the picture, the sky above";
        EXPECT_GE(event.time_ns, 50'000'000);
        EXPECT_LE(event.time_ns, 100'000'000);
    }
    EXPECT_TRUE(std::is_sorted(
        frame.events.begin(), frame.events.end(), [](const auto& one, const auto& other) {
            return one.time_ns < other.time_ns;
        }));
}

TEST(Events, OfATickAreTheSameAloneAsInSequence) {
    render::Sensors sensors(test::straight_road(400));
    seen(sensors, 90, 91);
    const world::SensorFrame later = seen(sensors, 98, 99);
    render::Sensors fresh(test::straight_road(400), {.threads = 1});
    EXPECT_EQ(seen(fresh, 98, 99).events, later.events);
}

}  // namespace reprise
