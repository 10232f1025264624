#include "render/optics/shutter.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/render/frames.h"

namespace reprise {

namespace {

using test::car_at;
using test::tick_with;
using world::SensorKind;

constexpr double speed = 20;  // [m/s]
constexpr double step = 0.05;

/// Beside the road: cars go from left to right.
world::SensorSpec roadside(SensorKind kind, std::vector<world::AttributeValue> attributes = {}) {
    world::SensorSpec spec = test::camera(kind, {100, -12, 1.2});
    spec.yaw = M_PI / 2;
    spec.attributes = std::move(attributes);
    return spec;
}

world::SealedTick with_car(double ago, std::uint64_t index = 2) {
    return tick_with({}, {car_at(7, 99 - speed * ago, -1.75, 0, speed)}, {}, index);
}

world::SensorFrame seen(render::Sensors& sensors,
                        const world::SealedTick& now,
                        const world::SealedTick& last,
                        const world::SensorSpec& spec) {
    render::Neighbours neighbours;
    neighbours.last = render::Neighbour{last.view(), {}};
    return sensors.observe(now.view(), {spec}, test::noon(), neighbours)[0];
}

int instance_at(const world::SensorFrame& frame, int u, int v) {
    const auto at = static_cast<std::size_t>(2 * (v * frame.width + u));
    return frame.data[at] + 256 * frame.data[at + 1];
}

}  // namespace

TEST(Shutter, OfAStillWorldIsThatOfAnInstant) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick still = with_car(0);
    const world::SealedTick before = with_car(0, 1);
    for (const SensorKind kind : {SensorKind::depth, SensorKind::semantic, SensorKind::instance})
        EXPECT_EQ(seen(sensors, still, before, roadside(kind, {{"readout_time", 30}})).data,
                  seen(sensors, still, before, roadside(kind)).data);
    const world::SensorFrame sharp = seen(sensors, still, before, roadside(SensorKind::rgb));
    const world::SensorFrame rolled =
        seen(sensors,
             still,
             before,
             roadside(SensorKind::rgb, {{"readout_time", 30}, {"motion_blur", 1}}));
    double off = 0;
    for (std::size_t i = 0; i < sharp.data.size(); ++i)
        off += std::abs(static_cast<double>(sharp.data[i]) - rolled.data[i]);
    EXPECT_LT(off / static_cast<double>(sharp.data.size()), 0.05);
}

TEST(Shutter, EachRowSeesACarWhereItWasThen) {
    render::Sensors sensors(test::straight_road(400));
    const world::SensorFrame rolled = seen(sensors,
                                           with_car(0),
                                           with_car(step, 1),
                                           roadside(SensorKind::instance, {{"readout_time", 50}}));
    int rows = 0;
    for (const render::Band& band :
         render::bands_of(roadside(SensorKind::instance, {{"readout_time", 50}}))) {
        const double ago = step * (1 - (band.first + band.rows / 2.0) / 120);
        EXPECT_NEAR(band.ago, ago, 1e-12);
        const world::SealedTick then = with_car(ago);
        const world::SensorFrame frozen =
            sensors.observe(then.view(), {roadside(SensorKind::instance)}, test::noon())[0];
        for (int v = band.first; v < band.first + band.rows; ++v) {
            int other = 0;
            int car = 0;
            for (int u = 0; u < 160; ++u) {
                other += instance_at(frozen, u, v) != instance_at(rolled, u, v) ? 1 : 0;
                car += instance_at(frozen, u, v) != 0 ? 1 : 0;
            }
            EXPECT_LE(other, 2) << v;
            rows += car > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(rows, 8) << "the car is in the picture";
}

TEST(Shutter, BlurIsTheMeanOfInstants) {
    render::Sensors sensors(test::straight_road(400));
    const std::vector<world::AttributeValue> straight{{"tone", 1}, {"gamma", 1}};
    std::vector<world::AttributeValue> blurring = straight;
    blurring.push_back({"motion_blur", 1});
    blurring.push_back({"shutter_speed", 20});
    blurring.push_back({"samples", 4});
    const world::SensorFrame blurred =
        seen(sensors, with_car(0), with_car(step, 1), roadside(SensorKind::rgb, blurring));
    std::vector<double> mean(blurred.data.size());
    for (int i = 0; i < 4; ++i) {
        const world::SealedTick then = with_car(step * (i + 0.5) / 4);
        const world::SensorFrame frozen =
            sensors.observe(then.view(), {roadside(SensorKind::rgb, straight)}, test::noon())[0];
        for (std::size_t k = 0; k < mean.size(); ++k)
            mean[k] += frozen.data[k] / 4.0;
    }
    double off = 0;
    double moved = 0;
    const world::SensorFrame sharp =
        seen(sensors, with_car(0), with_car(step, 1), roadside(SensorKind::rgb, straight));
    for (std::size_t k = 0; k < mean.size(); ++k) {
        off += std::abs(mean[k] - blurred.data[k]);
        moved += std::abs(static_cast<double>(sharp.data[k]) - blurred.data[k]);
    }
    // Wheels roll between ticks, which cars that were put there do not; white is cut before or
    // behind the mean.
    EXPECT_LT(off, 0.35 * moved);
    EXPECT_LT(off / static_cast<double>(mean.size()), 0.6);
}

TEST(Shutter, WhatIsInFocusStaysSharpAndWhatIsNearBlurs) {
    render::Sensors sensors(test::straight_road(400));
    // The car's side is 9.4 m away: pixels at its edges.
    const auto blurred_pixels = [&](double distance) {
        const world::SealedTick tick = with_car(0);
        const auto picture = [&](std::vector<world::AttributeValue> attributes) {
            return sensors.observe(
                tick.view(), {roadside(SensorKind::rgb, std::move(attributes))}, test::noon())[0];
        };
        const world::SensorFrame sharp = picture({});
        const world::SensorFrame soft = picture(
            {{"focal_distance", distance}, {"sensor_width", 36}, {"fstop", 0.5}, {"samples", 32}});
        double off = 0;
        for (int v = 50; v < 72; ++v)
            for (int u = 60; u < 120; ++u)
                for (int channel = 0; channel < 3; ++channel) {
                    const auto i = static_cast<std::size_t>(3 * (v * 160 + u) + channel);
                    off += std::abs(static_cast<double>(sharp.data[i]) - soft.data[i]);
                }
        return off;
    };
    EXPECT_LT(3 * blurred_pixels(9.6), blurred_pixels(0.8));
}

}  // namespace reprise
