#include "render/ranging/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/external/sensor_attributes.h"

namespace reprise::render {

namespace {

/// How many columns have begun by a time; times that are meant to be whole may miss by rounding.
std::uint64_t columns_until(double time, double per_second) {
    return static_cast<std::uint64_t>(std::max(0.0, std::floor(time * per_second + 1e-6)));
}

}  // namespace

Sweep sweep_of(const world::SensorSpec& spec, std::uint64_t tick) {
    constexpr double degree = std::numbers::pi / 180;
    const auto value = [&](const char* name) { return world::attribute(spec, name); };
    const auto channels = static_cast<std::size_t>(value("channels"));
    const double per_second = value("points_per_second") / static_cast<double>(channels);
    const double turns = value("rotation_frequency");
    const double fov = value("horizontal_fov") * degree;
    Sweep sweep;
    for (std::size_t i = 0; i < channels; ++i) {
        const double share =
            channels > 1 ? static_cast<double>(i) / static_cast<double>(channels - 1) : 0;
        sweep.elevations.push_back(
            degree * (value("upper_fov") + share * (value("lower_fov") - value("upper_fov"))));
    }
    const double end = static_cast<double>(tick) * spec.step;
    const double covered = std::min(static_cast<double>(spec.every) * spec.step, 1 / turns);
    const std::uint64_t first = columns_until(end - covered, per_second);
    const std::uint64_t last = columns_until(end, per_second);
    for (std::uint64_t number = first; number < last; ++number) {
        // A column is shot in the middle of its share of time.
        const double time = (static_cast<double>(number) + 0.5) / per_second;
        const double turned = time * turns;
        const double azimuth = (0.5 - (turned - std::floor(turned))) * fov;
        sweep.columns.push_back({number, azimuth, std::max(0.0, end - time)});
    }
    return sweep;
}

}  // namespace reprise::render
