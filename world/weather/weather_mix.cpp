#include "world/weather/weather_mix.h"

#include <cmath>
#include <numbers>

namespace reprise::world {

namespace {

float mixed(float from, float to, double share) {
    if (share >= 1)
        return to;
    const auto start = static_cast<double>(from);
    return static_cast<float>(start + share * (static_cast<double>(to) - start));
}

/// The shorter way round.
float mixed_angle(float from, float to, double share) {
    const double way =
        std::remainder(static_cast<double>(to) - static_cast<double>(from), 2 * std::numbers::pi);
    return share >= 1 ? to : static_cast<float>(static_cast<double>(from) + share * way);
}

}  // namespace

Weather mixed(const Weather& from, const Weather& to, double share) {
    return {mixed_angle(from.sun_azimuth(), to.sun_azimuth(), share),
            mixed(from.sun_altitude(), to.sun_altitude(), share),
            mixed(from.cloud_cover(), to.cloud_cover(), share),
            mixed(from.rain(), to.rain(), share),
            mixed(from.fog_extinction(), to.fog_extinction(), share),
            mixed(from.wetness(), to.wetness(), share),
            mixed(from.puddles(), to.puddles(), share),
            mixed(from.wind_speed(), to.wind_speed(), share),
            mixed_angle(from.wind_azimuth(), to.wind_azimuth(), share),
            mixed(from.turbidity(), to.turbidity(), share),
            mixed(from.fog_base(), to.fog_base(), share),
            mixed(from.fog_falloff(), to.fog_falloff(), share),
            mixed(from.snow(), to.snow(), share),
            mixed(from.snow_cover(), to.snow_cover(), share),
            mixed(from.dust(), to.dust(), share)};
}

}  // namespace reprise::world
