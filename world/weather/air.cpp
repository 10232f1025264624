#include "world/weather/air.h"

#include <algorithm>
#include <cmath>

namespace reprise::world {

double rain_extinction(double rain) {
    return rain > 0 ? 3.65e-4 * std::pow(rain, 0.63) : 0;
}

double snow_extinction(double snow) {
    return 3e-3 * snow;
}

double fog_extinction_at(const Weather& weather, double height) {
    const double above = std::max(0.0, height - static_cast<double>(weather.fog_base()));
    return static_cast<double>(weather.fog_extinction()) *
           std::exp(-static_cast<double>(weather.fog_falloff()) * above);
}

double mean_fog_extinction(const Weather& weather, double from_height, double to_height) {
    const auto base = static_cast<double>(weather.fog_base());
    const auto falloff = static_cast<double>(weather.fog_falloff());
    const double low = std::min(from_height, to_height);
    const double high = std::max(from_height, to_height);
    const double rise = high - low;
    if (rise * falloff < 1e-6)
        return fog_extinction_at(weather, low);
    // Below the base it is even; above, the integral of e^(-k h) has a closed form.
    const double below = std::clamp(base - low, 0.0, rise);
    const double from = std::max(low - base, 0.0);
    const double to = std::max(high - base, 0.0);
    const double above = (std::exp(-falloff * from) - std::exp(-falloff * to)) / falloff;
    return static_cast<double>(weather.fog_extinction()) * (below + above) / rise;
}

double even_extinction(const Weather& weather) {
    return rain_extinction(static_cast<double>(weather.rain())) +
           snow_extinction(static_cast<double>(weather.snow())) +
           static_cast<double>(weather.dust());
}

}  // namespace reprise::world
