#include "render/ranging/radar_link.h"

#include <cmath>
#include <numbers>

namespace reprise::render {

double signal_to_noise(double cross_section, double range, double gain, double loss) {
    constexpr double wave = 299'792'458 / 77e9;           // [m]
    constexpr double power = 0.0158;                      // [W] 12 dBm
    constexpr double antenna = 251;                       // 24 dBi
    constexpr double losses = 31.6;                       // 15 dB
    constexpr double noise = 1.38e-23 * 290 * 50 * 15.8;  // [W] k T B F, B = 1 / 20 ms
    constexpr double sphere = 4 * std::numbers::pi;
    const double squared = range * range;
    const double arrived = power * antenna * antenna * gain * gain * wave * wave * cross_section /
                           (sphere * sphere * sphere * squared * squared * losses);
    return arrived / noise * std::pow(10.0, -2 * loss * range / 1000 / 10);
}

double antenna_gain(double angle, double fov) {
    const double share = angle / (fov / 2);
    return std::exp(-std::numbers::ln2 * share * share);
}

double rain_loss(double mm_per_hour) {
    return mm_per_hour > 0 ? 1.132 * std::pow(mm_per_hour, 0.7177) : 0;
}

}  // namespace reprise::render
