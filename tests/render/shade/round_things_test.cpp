#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/render/frames.h"
#include "world/models/catalogue.h"

namespace reprise {
namespace {

/// Of two frames, the share of the places on somebody that are a sixth darker or brighter than what
/// is left and right of them on the same one.
double streaks(const world::SensorFrame& rgb, const world::SensorFrame& instances) {
    const auto light = [&](std::size_t i) {
        return rgb.data[3 * i] + rgb.data[3 * i + 1] + rgb.data[3 * i + 2];
    };
    const auto number = [&](std::size_t i) {
        std::uint16_t value = 0;
        std::memcpy(&value, &instances.data[2 * i], sizeof(value));
        return value;
    };
    double found = 0;
    double all = 0;
    for (std::size_t i = 1; i + 1 < instances.data.size() / 2; ++i) {
        if (number(i) == 0 || number(i) != number(i - 1) || number(i) != number(i + 1))
            continue;
        const int own = 6 * light(i);
        ++all;
        found += own < 5 * std::min(light(i - 1), light(i + 1)) ||
                 own > 7 * std::max(light(i - 1), light(i + 1));
    }
    return found / all;
}

/// Legs and arms have twelve sides. Where each of them is lit by itself, few rays a side leave
/// streaks, and legs look like wood.
TEST(RoundThings, HaveNoStreaks) {
    world::TickDraft draft;
    const auto models = static_cast<std::uint16_t>(world::walker_models().size());
    for (std::uint16_t model = 0; model < models; ++model)
        draft.traffic.walkers.emplace_back(world::Vec3(100 + model % 2, -9 + 0.5 * model, 0),
                                           3.1F,
                                           1.2F,
                                           0.1F * static_cast<float>(model),
                                           20U + model,
                                           model,
                                           false,
                                           std::uint8_t{0},
                                           0U);
    world::SensorSpec rgb = test::camera(world::SensorKind::rgb, {88, -1, 0.35});
    rgb.width = 1600;
    rgb.height = 120;
    rgb.fov = 0.6;
    world::SensorSpec instances = rgb;
    instances.kind = world::SensorKind::instance;
    instances.name = "instance";
    render::Sensors sensors(test::straight_road(200));
    const world::SealedTick tick = world::seal(draft, {});
    const auto frames = sensors.observe(tick.view(), {rgb, instances}, test::noon());
    EXPECT_LT(streaks(frames[0], frames[1]), 0.03);
}

}  // namespace
}  // namespace reprise
