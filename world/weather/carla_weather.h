#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "world/common_generated.h"

namespace reprise::world {

/// CARLA's WeatherParameters: 14 numbers, in the order of its message. Percentages but for the
/// angles [deg] and the fog's distance [m].
inline constexpr std::array<const char*, 14> carla_weather_keys{"cloudiness",
                                                                "precipitation",
                                                                "precipitation_deposits",
                                                                "wind_intensity",
                                                                "sun_azimuth_angle",
                                                                "sun_altitude_angle",
                                                                "fog_density",
                                                                "fog_distance",
                                                                "fog_falloff",
                                                                "wetness",
                                                                "scattering_intensity",
                                                                "mie_scattering_scale",
                                                                "rayleigh_scattering_scale",
                                                                "dust_storm"};
using CarlaWeather = std::array<double, carla_weather_keys.size()>;

struct CarlaPreset {
    std::string name;
    CarlaWeather weather;
};

/// Its 23: Default, 7 weathers x Noon, Sunset, Night, and DustStorm.
const std::vector<CarlaPreset>& carla_presets();

/// Once, into physical units. What has no counterpart is left out: fog_distance, and the three
/// scatterings, which the sky has from its own air.
Weather weather_of(const CarlaWeather& carla);

/// "'fog_density' must be in [0, 100]", or "" when the value can be.
std::string trouble_with(std::size_t key, double value);

}  // namespace reprise::world
