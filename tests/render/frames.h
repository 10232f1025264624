#pragma once

#include <cstring>
#include <utility>

#include "render/sensors.h"
#include "tests/support/worlds.h"
#include "world/weather/weather.h"

/// Short ways to small pictures.
namespace reprise::test {

inline const world::Weather& noon() {
    return world::find_weather("clear_noon")->weather;
}

inline const world::Weather& rain() {
    return world::find_weather("hard_rain_sunset")->weather;
}

/// On a pole 1.4 m above the world's origin, looking east, unless told otherwise.
inline world::SensorSpec camera(world::SensorKind kind, Eigen::Vector3d position = {0, 0, 1.4}) {
    world::SensorSpec spec;
    spec.name = "camera";
    spec.kind = kind;
    spec.width = 160;
    spec.height = 120;
    spec.position = std::move(position);
    return spec;
}

inline float depth_at(const world::SensorFrame& frame, int u, int v) {
    float depth = 0;
    const auto index = static_cast<std::size_t>(v * frame.width + u);
    std::memcpy(&depth, frame.data.data() + index * sizeof(float), sizeof(float));
    return depth;
}

inline world::SemanticClass class_at(const world::SensorFrame& frame, int u, int v) {
    return static_cast<world::SemanticClass>(
        frame.data[static_cast<std::size_t>(v * frame.width + u)]);
}

/// Mean of a channel over a rectangle of an RGB frame; corners included.
inline double mean(
    const world::SensorFrame& frame, int channel, int left, int top, int right, int bottom) {
    double sum = 0;
    for (int v = top; v <= bottom; ++v)
        for (int u = left; u <= right; ++u)
            sum += frame.data[static_cast<std::size_t>(3 * (v * frame.width + u) + channel)];
    return sum / ((right - left + 1) * (bottom - top + 1));
}

}  // namespace reprise::test
