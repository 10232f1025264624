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
    const char* source = "";   ///< where its kind comes from: "paper", "CARLA", "own"
};

/// The paper's 2 lightings x 9 weathers, nights, fog, snow and dust in snake_case; then CARLA's 23
/// under CARLA's names, such as ClearNoon, with CARLA's numbers.
const std::vector<WeatherPreset>& weather_presets();

/// Null when there is none of that name.
const WeatherPreset* find_weather(std::string_view name);

std::vector<std::string> weather_names();

/// The grip that a weather leaves of dry asphalt's, where no preset says it: 0.75 wet, 0.68 under a
/// cloudburst (Mitschke/Wallentowitz, ch. 2), 0.33 on packed snow.
double road_friction_in(const Weather& weather);

}  // namespace reprise::world
