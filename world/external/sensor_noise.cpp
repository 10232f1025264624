#include "world/external/sensor_noise.h"

#include <algorithm>
#include <cmath>

namespace reprise::world {

namespace {

/// splitmix64, as world/random.h.
constexpr std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// FNV-1a.
constexpr std::uint64_t bits_of(std::string_view text) {
    std::uint64_t bits = 0xcbf29ce484222325u;
    for (const char letter : text)
        bits = (bits ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
    return bits;
}

/// Of a tail that holds `share` of the distribution.
double tail_quantile(double share) {
    const double q = std::sqrt(-2 * std::log(share));
    return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838) * q -
              2.549732539343734) *
                 q +
             4.374664141464968) *
                q +
            2.938163982698783) /
           ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996) * q +
             3.754408661907416) *
                q +
            1);
}

}  // namespace

double normal_quantile(double probability) {
    constexpr double tail = 0.02425;
    if (probability < tail)
        return tail_quantile(probability);
    if (probability > 1 - tail)
        return -tail_quantile(1 - probability);
    const double q = probability - 0.5;
    const double r = q * q;
    return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) *
                  r +
              1.383577518672690e+02) *
                 r -
             3.066479806614716e+01) *
                r +
            2.506628277459239) *
           q /
           (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) *
                  r +
              6.680131188771972e+01) *
                 r -
             1.328068155288572e+01) *
                r +
            1);
}

SensorNoise::SensorNoise(std::uint64_t seed, std::string_view sensor, std::uint64_t tick)
    : key_(mixed(mixed(mixed(seed) ^ bits_of(sensor)) ^ tick)) {}

double SensorNoise::uniform(std::uint64_t item, std::uint32_t which) const {
    return static_cast<double>(mixed(mixed(key_ ^ item) ^ which) >> 11) * 0x1.0p-53;
}

double SensorNoise::normal(std::uint64_t item, std::uint32_t which) const {
    return normal_quantile(std::max(uniform(item, which), 0x1.0p-54));
}

}  // namespace reprise::world
