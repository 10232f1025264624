#include "world/weather/weather.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "world/weather/carla_weather.h"

namespace reprise::world {

namespace {

constexpr float degrees(double angle) {
    return static_cast<float>(angle * std::numbers::pi / 180.0);
}

/// Where the sun stands.
struct Lighting {
    const char* name;
    double azimuth_deg;
    double altitude_deg;
};

/// All of a weather but the sun; the wind blows to 20 degrees from east.
struct Air {
    const char* name;
    float clouds;
    float rain;  ///< [mm/h]
    float fog;   ///< [1/m]
    float wetness;
    float puddles;
    float wind;  ///< [m/s]
    float turbidity;
    double friction;
};

constexpr Lighting noon{"noon", -110, 55};
constexpr Lighting sunset{"sunset", -165, 9};
constexpr Lighting night{"night", -165, -30};

// The paper's nine (Dosovitskiy et al., CoRL 2017, sec. 3) differ in cloud cover, precipitation and
// puddles: three covers, dry and after rain, and three rains. Fog: meteorological range 3 /
// extinction, so 20 km and 600 m. Rain of 50 mm/h is a cloudburst; 2 and 8 are light and moderate
// (WMO). Wet asphalt keeps about two thirds of its grip (Mitschke/Wallentowitz, ch. 2).
constexpr std::array<Air, 9> airs{{
    {"clear", 0.05F, 0, 1.5e-4F, 0, 0, 1.5F, 2.5F, 1.0},
    {"cloudy", 0.6F, 0, 2e-4F, 0, 0, 3, 3, 1.0},
    {"overcast", 1, 0, 3e-4F, 0, 0, 3, 3.5F, 1.0},
    {"wet", 0.05F, 0, 2e-4F, 0.9F, 0.5F, 1.5F, 2.5F, 0.75},
    {"wet_cloudy", 0.6F, 0, 3e-4F, 0.9F, 0.5F, 3, 3, 0.75},
    {"wet_overcast", 1, 0, 5e-4F, 0.9F, 0.5F, 3, 3.5F, 0.75},
    {"soft_rain", 0.7F, 2, 5e-4F, 0.8F, 0.25F, 3, 3, 0.75},
    {"mid_rain", 0.8F, 8, 1.5e-3F, 1, 0.45F, 5, 3.5F, 0.70},
    {"hard_rain", 0.85F, 50, 5e-3F, 1, 0.6F, 8, 4, 0.68},
}};

Weather composed(const Lighting& light, const Air& air) {
    return {degrees(light.azimuth_deg),
            degrees(light.altitude_deg),
            air.clouds,
            air.rain,
            air.fog,
            air.wetness,
            air.puddles,
            air.wind,
            degrees(20),
            air.turbidity,
            0,
            0,
            0,
            0,
            0};
}

void add_lighting(std::vector<WeatherPreset>& presets, const Lighting& light, const char* source) {
    for (const Air& air : airs)
        presets.push_back(
            {std::string(air.name) + "_" + light.name, composed(light, air), air.friction, source});
}

void add_own(std::vector<WeatherPreset>& presets) {
    const auto add = [&](const char* name, const Weather& weather) {
        presets.push_back({name, weather, road_friction_in(weather), "own"});
    };
    Weather weather = composed(noon, airs[2]);
    weather.mutate_fog_extinction(3.0F / 150);
    weather.mutate_wetness(0.35F);
    weather.mutate_wind_speed(0.5F);
    add("foggy_noon", weather);
    // Fog of the ground on a clear morning: thick to a storey's height, gone above the roofs.
    weather = composed({"", 5, 14}, airs[0]);
    weather.mutate_fog_extinction(3.0F / 120);
    weather.mutate_fog_base(3);
    weather.mutate_fog_falloff(1.0F / 12);
    weather.mutate_wetness(0.25F);
    weather.mutate_wind_speed(0.3F);
    add("foggy_morning", weather);
    weather = composed(noon, airs[0]);
    weather.mutate_sun_altitude(degrees(22));
    weather.mutate_snow_cover(0.9F);
    add("snowy_noon", weather);
    weather = composed(noon, airs[2]);
    weather.mutate_sun_altitude(degrees(22));
    weather.mutate_snow(2);
    weather.mutate_snow_cover(0.75F);
    weather.mutate_wetness(0.3F);
    add("snowfall_noon", weather);
    weather.mutate_sun_altitude(degrees(-30));
    add("snowfall_night", weather);
    weather = composed(noon, airs[1]);
    weather.mutate_dust(3.0F / 180);
    weather.mutate_wind_speed(15);
    weather.mutate_turbidity(8);
    add("dust_storm", weather);
}

std::vector<WeatherPreset> all_presets() {
    std::vector<WeatherPreset> presets;
    add_lighting(presets, noon, "paper");
    add_lighting(presets, sunset, "paper");
    add_lighting(presets, night, "CARLA's kind");
    add_own(presets);
    for (const CarlaPreset& preset : carla_presets()) {
        const Weather weather = weather_of(preset.weather);
        presets.push_back({preset.name, weather, road_friction_in(weather), "CARLA"});
    }
    return presets;
}

}  // namespace

const std::vector<WeatherPreset>& weather_presets() {
    static const std::vector<WeatherPreset> presets = all_presets();
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

double road_friction_in(const Weather& weather) {
    const auto wet = static_cast<double>(weather.wetness());
    const auto rain = static_cast<double>(weather.rain());
    const double on_ground = 1 - 0.25 * wet - 0.07 * std::min(1.0, rain / 50);
    const auto snow = static_cast<double>(weather.snow_cover());
    return on_ground + snow * (0.33 - on_ground);
}

}  // namespace reprise::world
