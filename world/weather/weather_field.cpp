#include "world/weather/weather_field.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "world/weather/air.h"

namespace reprise::world {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double visible = range_by_extinction;

#define REPRISE_OF(name) &Weather::name, &Weather::mutate_##name
const std::array<WeatherField, 18> fields{{
    {"sun_azimuth_deg",
     "sun_azimuth",
     "deg",
     -360,
     360,
     degree,
     false,
     "counter-clockwise from east",
     REPRISE_OF(sun_azimuth)},
    {"sun_altitude_deg",
     "sun_altitude",
     "deg",
     -90,
     90,
     degree,
     false,
     "above the horizon",
     REPRISE_OF(sun_altitude)},
    {"cloud_cover", "clouds", "", 0, 1, 1, false, "share of the sky", REPRISE_OF(cloud_cover)},
    {"rain_mm_h",
     "rain",
     "mm/h",
     0,
     200,
     1,
     false,
     "2 is light, 8 moderate, 50 a cloudburst",
     REPRISE_OF(rain)},
    {"visibility",
     "fog",
     "m",
     10,
     100'000,
     visible,
     true,
     "how far fog lets one see (5 % contrast)",
     REPRISE_OF(fog_extinction)},
    {"wetness",
     "",
     "",
     0,
     1,
     1,
     false,
     "how much of the road's pores is filled",
     REPRISE_OF(wetness)},
    {"puddles", "", "", 0, 1, 1, false, "share of the low spots under water", REPRISE_OF(puddles)},
    {"wind_speed",
     "wind",
     "m/s",
     0,
     60,
     1,
     false,
     "slants rain, moves clouds",
     REPRISE_OF(wind_speed)},
    {"wind_to_deg",
     "wind_to",
     "deg",
     -360,
     360,
     degree,
     false,
     "the direction that it blows to",
     REPRISE_OF(wind_azimuth)},
    {"turbidity", "", "", 1.7, 10, 1, false, "haze; 2 is very clear air", REPRISE_OF(turbidity)},
    {"okta",
     "",
     "/8",
     0,
     8,
     1.0 / 8,
     false,
     "clouds as observers count them",
     REPRISE_OF(cloud_cover)},
    {"film_mm",
     "film",
     "mm",
     0,
     film_mm_when_wet,
     1 / film_mm_when_wet,
     false,
     "wetness as a film of water",
     REPRISE_OF(wetness)},
    {"puddle_mm",
     "puddle",
     "mm",
     0,
     deepest_puddle_mm,
     1 / deepest_puddle_mm,
     false,
     "puddles by the depth of the deepest",
     REPRISE_OF(puddles)},
    {"fog_base",
     "",
     "m",
     0,
     5000,
     1,
     false,
     "up to this height fog is as thick as said",
     REPRISE_OF(fog_base)},
    {"fog_falloff",
     "",
     "1/m",
     0,
     1,
     1,
     false,
     "how fast it thins above; 0: it has no top",
     REPRISE_OF(fog_falloff)},
    {"snow_mm_h",
     "snow",
     "mm/h",
     0,
     50,
     1,
     false,
     "as water; 1 is moderate snowfall",
     REPRISE_OF(snow)},
    {"snow_cover",
     "",
     "",
     0,
     1,
     1,
     false,
     "share of the ground and roofs under snow",
     REPRISE_OF(snow_cover)},
    {"dust_visibility",
     "dust",
     "m",
     10,
     100'000,
     visible,
     true,
     "how far dust lets one see",
     REPRISE_OF(dust)},
}};
#undef REPRISE_OF

}  // namespace

std::span<const WeatherField> weather_fields() {
    return fields;
}

const WeatherField* find_weather_field(std::string_view name) {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const WeatherField& each) {
        return each.is_named(name);
    });
    return found == fields.end() ? nullptr : &*found;
}

}  // namespace reprise::world
