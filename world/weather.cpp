#include "world/weather.h"

#include <numbers>

namespace reprise::world {

namespace {

constexpr float degrees(double angle) {
    return static_cast<float>(angle * std::numbers::pi / 180.0);
}

}  // namespace

const std::vector<WeatherPreset>& weather_presets() {
    // Fields: sun azimuth, sun altitude, clouds, rain, fog, wetness, puddles, wind speed and
    // azimuth, turbidity. Fog: meteorological range 3 / extinction, so 20 km and 600 m. Rain of 50
    // mm/h is a cloudburst; wet asphalt keeps about two thirds of its grip (Mitschke/Wallentowitz,
    // ch. 2).
    static const std::vector<WeatherPreset> presets{
        {"clear_noon",
         Weather(degrees(-110), degrees(55), 0.05F, 0, 1.5e-4F, 0, 0, 1.5F, degrees(20), 2.5F),
         1.0},
        {"hard_rain_sunset",
         Weather(degrees(-165), degrees(9), 0.85F, 50, 5e-3F, 1, 0.6F, 8, degrees(20), 4),
         0.68},
    };
    return presets;
}

const WeatherPreset* find_weather(std::string_view name) {
    for (const WeatherPreset& preset : weather_presets())
        if (preset.name == name)
            return &preset;
    return nullptr;
}

std::vector<std::string> weather_names() {
    std::vector<std::string> names;
    for (const WeatherPreset& preset : weather_presets())
        names.push_back(preset.name);
    return names;
}

}  // namespace reprise::world
