#include "world/weather/carla_weather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace reprise::world {

namespace {

enum Key : std::size_t {
    cloudiness,
    precipitation,
    deposits,
    wind,
    azimuth,
    altitude,
    fog_density,
    fog_distance,
    fog_falloff,
    wetness,
    scattering,
    mie,
    rayleigh,
    dust,
};

/// One of the seven weathers that CARLA has at noon, at sunset and at night. Values: carla-rust's
/// weather.rs, a mirror of LibCarla/source/carla/rpc/WeatherParameters.cpp.
struct Kind {
    const char* name;
    double clouds;
    double rain;
    double deposits;
    double wind;
    double fog_noon;
    double fog_sunset;
    double fog_night;
    double clouds_night;
    double wet_night;
};

constexpr std::array<Kind, 7> kinds{{
    {"Clear", 5, 0, 0, 10, 2, 2, 60, 5, 0},
    {"Cloudy", 60, 0, 0, 10, 3, 3, 60, 60, 0},
    {"Wet", 5, 0, 50, 10, 3, 2, 60, 5, 60},
    {"WetCloudy", 60, 0, 50, 10, 3, 2, 60, 60, 60},
    {"SoftRain", 20, 30, 50, 30, 3, 2, 60, 60, 60},
    {"MidRainy", 60, 60, 60, 60, 3, 3, 60, 80, 80},
    {"HardRain", 100, 100, 90, 100, 7, 7, 100, 100, 100},
}};

/// At its azimuth of -1 "as the map has it", we put the sun where our noon has it.
constexpr double no_azimuth = -1;

CarlaWeather values(double clouds,
                    double rain,
                    double water,
                    double wind_intensity,
                    double sun,
                    double fog,
                    double wet,
                    double dust_storm) {
    return {clouds,
            rain,
            water,
            wind_intensity,
            no_azimuth,
            sun,
            fog,
            0.75,
            0.1,
            wet,
            1.0,
            0.03,
            0.0331,
            dust_storm};
}

std::vector<CarlaPreset> make_presets() {
    std::vector<CarlaPreset> presets;
    // Default leaves the map's own weather, which is a clear day.
    presets.push_back({"Default", values(5, 0, 0, 10, 45, 2, 0, 0)});
    for (const Kind& kind : kinds)
        presets.push_back(
            {std::string(kind.name) + "Noon",
             values(kind.clouds, kind.rain, kind.deposits, kind.wind, 45, kind.fog_noon, 0, 0)});
    for (const Kind& kind : kinds)
        presets.push_back(
            {std::string(kind.name) + "Sunset",
             values(kind.clouds, kind.rain, kind.deposits, kind.wind, 15, kind.fog_sunset, 0, 0)});
    for (const Kind& kind : kinds)
        presets.push_back({std::string(kind.name) + "Night",
                           values(kind.clouds_night,
                                  kind.rain,
                                  kind.deposits,
                                  kind.wind,
                                  -90,
                                  kind.fog_night,
                                  kind.wet_night,
                                  0)});
    presets.push_back({"DustStorm", values(100, 0, 0, 100, 45, 2, 0, 100)});
    return presets;
}

float radians(double angle_deg) {
    return static_cast<float>(angle_deg * std::numbers::pi / 180);
}

}  // namespace

const std::vector<CarlaPreset>& carla_presets() {
    static const std::vector<CarlaPreset> presets = make_presets();
    return presets;
}

Weather weather_of(const CarlaWeather& carla) {
    const auto share = [&](Key key) { return carla[key] / 100; };
    // Light drizzle at 15, a cloudburst of 50 mm/h at 100.
    const double rain = 50 * share(precipitation) * std::sqrt(share(precipitation));
    // 20 km at 0, 30 m at 100, each percent by the same factor. Its fog thins upwards by
    // `fog_falloff` a metre of the engine's own scale; at ours, 0.1 is a layer of 50 m.
    const double range = 20'000 * std::pow(30.0 / 20'000, share(fog_density));
    // Deposits are the water that lies; what falls and what lies both wet the road.
    const double water = share(deposits);
    const double wet = std::max({share(wetness), std::min(1.0, 1.8 * water), rain / (rain + 1)});
    // Compass-like and clockwise from its east (x ahead, y right).
    const double sun_azimuth = carla[azimuth] == no_azimuth ? -110 : -carla[azimuth];
    Weather weather;
    weather.mutate_sun_azimuth(radians(sun_azimuth));
    weather.mutate_sun_altitude(radians(carla[altitude]));
    weather.mutate_cloud_cover(static_cast<float>(share(cloudiness)));
    weather.mutate_rain(static_cast<float>(rain));
    weather.mutate_fog_extinction(static_cast<float>(3 / range));
    weather.mutate_wetness(static_cast<float>(wet));
    weather.mutate_puddles(static_cast<float>(water));
    weather.mutate_wind_speed(static_cast<float>(15 * share(wind)));
    weather.mutate_wind_azimuth(radians(20));
    weather.mutate_turbidity(static_cast<float>(2.5 + 1.5 * share(cloudiness)));
    weather.mutate_fog_falloff(static_cast<float>(carla[fog_falloff] * 0.2 * share(fog_density)));
    weather.mutate_dust(static_cast<float>(3.0 / 150 * share(dust) * share(dust)));
    return weather;
}

std::string trouble_with(std::size_t key, double value) {
    double low = 0;
    double high = 100;
    if (key == azimuth) {
        low = no_azimuth;
        high = 360;
    } else if (key == altitude) {
        low = -90;
        high = 90;
    } else if (key == fog_distance) {
        high = 1e6;
    } else if (key == fog_falloff) {
        high = 10;
    }
    if (value >= low && value <= high)
        return "";
    return fmt::format(
        "'{}' must be in [{}, {}], got {}", carla_weather_keys[key], low, high, value);
}

}  // namespace reprise::world
