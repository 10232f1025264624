#include "render/ranging/fog_return.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/ranging/precipitation.h"

namespace reprise::render {

namespace {

constexpr double light_speed = 299'792'458;  // [m/s]
constexpr double half_pulse = 20e-9;         // [s] width at half of the power
constexpr double step = 0.05;                // [m] of the table, and of the integral
constexpr double farthest_peak = 15;         // [m] behind it fog adds nothing to the peak

}  // namespace

double visibility_of(double extinction) {
    return std::log(20.0) / extinction;
}

FogReturn::FogReturn(double extinction) {
    if (!(extinction > 0)) {
        peaks_.push_back({});
        return;
    }
    const double backscatter = 0.046 / visibility_of(extinction);  // [1/(m sr)]
    const double of_target = 1e-6 / std::numbers::pi;              // Hahner's beta_0
    // An integral over time, which the constants are for: dt = 2 dr / c.
    const double share = backscatter / of_target * 2 / light_speed * step;
    constexpr auto count = static_cast<std::size_t>(farthest_peak / step);
    constexpr auto length = static_cast<std::size_t>(light_speed * half_pulse / step);
    std::vector<double> from(count);    // what droplets at a distance send back
    std::vector<double> pulse(length);  // the pulse, by the way that it is ahead of its end
    for (std::size_t i = 0; i < count; ++i) {
        const double r = (static_cast<double>(i) + 0.5) * step;
        from[i] = share * overlap(r) * std::exp(-2 * extinction * r) / (r * r);
    }
    for (std::size_t i = 0; i < length; ++i) {
        const double wave = std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) /
                                     static_cast<double>(length));
        pulse[i] = wave * wave;
    }
    // Each instant sums droplets from behind the pulse's front up to a surface: prefixes of one
    // sum.
    peaks_.resize(count + 1);
    std::vector<Peak> whole(count + 1);
    for (std::size_t instant = 1; instant <= count; ++instant) {
        double sum = 0;
        const double range = static_cast<double>(instant) * step;
        for (std::size_t i = instant > length ? instant - length : 0; i < instant; ++i) {
            sum += pulse[instant - 1 - i] * from[i];
            if (sum > peaks_[i + 1].power)
                peaks_[i + 1] = {range, sum};
        }
        whole[instant] = {range, sum};
    }
    Peak best;
    for (std::size_t surface = 0; surface <= count; ++surface) {
        if (whole[surface].power > best.power)
            best = whole[surface];
        if (best.power >= peaks_[surface].power)
            peaks_[surface] = best;
    }
}

FogReturn::Peak FogReturn::before(double range) const {
    if (!(range > 0))
        return {};
    const double place = range / step;
    const auto last = static_cast<double>(peaks_.size() - 1);
    return peaks_[place >= last ? peaks_.size() - 1 : static_cast<std::size_t>(place)];
}

}  // namespace reprise::render
