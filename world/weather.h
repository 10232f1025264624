#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "world/common_generated.h"

namespace reprise::world {

/// A named weather. `road_friction` belongs to it only when it is chosen for a *run*; rendering a
/// trace under another weather changes pictures, never physics.
struct WeatherPreset {
    std::string name;
    Weather weather;
    double road_friction = 1;  ///< factor on dry asphalt's grip
};

/// clear_noon and hard_rain_sunset, in this order.
const std::vector<WeatherPreset>& weather_presets();

/// Null when there is none of that name.
const WeatherPreset* find_weather(std::string_view name);

std::vector<std::string> weather_names();

}  // namespace reprise::world
