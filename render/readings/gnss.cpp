#include <cmath>
#include <numbers>

#include "render/readings/mounted.h"
#include "render/readings/readings.h"
#include "world/external/sensor_attributes.h"
#include "world/external/sensor_noise.h"

namespace reprise::render {

GlobePlace place_on_globe(const GlobePlace& origin, double east, double north) {
    constexpr double degree = std::numbers::pi / 180;
    constexpr double radius = 6'378'137;              // [m] WGS 84, at the equator
    constexpr double squared = 6.694379990141317e-3;  // eccentricity
    const double sine = std::sin(origin.latitude_deg * degree);
    const double w = 1 - squared * sine * sine;
    const double across = radius / std::sqrt(w);      // east to west
    const double along = across * (1 - squared) / w;  // south to north
    return {
        origin.latitude_deg + north / along / degree,
        origin.longitude_deg + east / (across * std::cos(origin.latitude_deg * degree)) / degree};
}

Eigen::Vector3d antenna_place(const world::TickView& tick, const world::SensorSpec& spec) {
    return mounted(tick, spec).pose_world_sensor.translation();
}

world::Reading gnss_reading(std::uint64_t tick,
                            const world::SensorSpec& spec,
                            const GlobePlace& place,
                            double height) {
    const auto value = [&](const char* name) { return world::attribute(spec, name); };
    const world::SensorNoise noise(
        static_cast<std::uint64_t>(value("noise_seed")), spec.name, tick);
    return {place.latitude_deg + value("noise_lat_bias") +
                value("noise_lat_stddev") * noise.normal(0, 0),
            place.longitude_deg + value("noise_lon_bias") +
                value("noise_lon_stddev") * noise.normal(0, 1),
            height + value("altitude") + value("noise_alt_bias") +
                value("noise_alt_stddev") * noise.normal(0, 2)};
}

}  // namespace reprise::render
