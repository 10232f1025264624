#pragma once

#include <bit>
#include <cmath>
#include <cstring>

#include "tests/render/street.h"

/// Short ways to the rows of ranging sensors.
namespace reprise::test {

/// On a pole 1.8 m above the world's origin, looking east, without losses and errors.
inline world::SensorSpec ranger(world::SensorKind kind,
                                std::vector<world::AttributeValue> said = {}) {
    world::SensorSpec spec;
    spec.name = "ranger";
    spec.kind = kind;
    spec.position = {0, 0, 1.8};
    spec.attributes = std::move(said);
    const auto unless_said = [&](const char* name, double value) {
        for (const world::AttributeValue& one : spec.attributes)
            if (one.name == name)
                return;
        spec.attributes.push_back({name, value});
    };
    if (kind == world::SensorKind::lidar || kind == world::SensorKind::semantic_lidar) {
        unless_said("range", 100);
        unless_said("points_per_second", 320000);
        unless_said("rotation_frequency", 20);
    }
    if (kind == world::SensorKind::lidar) {
        unless_said("dropoff_general_rate", 0);
        unless_said("dropoff_zero_intensity", 0);
        unless_said("range_accuracy", 0);
        unless_said("atmosphere_attenuation_rate", 0);
    }
    return spec;
}

inline world::Weather clear() {
    world::Weather weather = noon();
    weather.mutate_rain(0);
    weather.mutate_fog_extinction(0);
    weather.mutate_wetness(0);
    return weather;
}

inline std::uint32_t whole_at(const world::SensorFrame& frame, int row, int column) {
    std::uint32_t word = 0;
    const auto index = static_cast<std::size_t>(row * frame.channels + column);
    std::memcpy(&word, frame.data.data() + index * sizeof(word), sizeof(word));
    return word;
}

inline double real_at(const world::SensorFrame& frame, int row, int column) {
    return static_cast<double>(std::bit_cast<float>(whole_at(frame, row, column)));
}

inline Eigen::Vector3d point_at(const world::SensorFrame& frame, int row) {
    return {real_at(frame, row, 0), real_at(frame, row, 1), real_at(frame, row, 2)};
}

}  // namespace reprise::test
