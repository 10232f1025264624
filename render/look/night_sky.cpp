#include "render/look/night_sky.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// [deg] and decimal logarithm of [lx]; the steps between are about even in the logarithm.
constexpr std::array<std::array<double, 2>, 6> twilight{
    {{-18, -3.22}, {-15, -2.85}, {-12, -2.10}, {-9, -0.78}, {-6, 0.53}, {0, 2.813}}};

/// From 0 at `low` to 1 at `high`, even in the logarithm of what must not be negative.
float rise(float low, float high, float x) {
    const double share = std::log(static_cast<double>(std::max(x, 1e-9F) / low)) /
                         std::log(static_cast<double>(high / low));
    return smooth_step(0, 1, static_cast<float>(share));
}

}  // namespace

float twilight_illuminance(float altitude) {
    const double deg = std::clamp(static_cast<double>(altitude) * 57.29577951, -18.0, 0.0);
    std::size_t next = 1;
    while (next + 1 < twilight.size() && deg > twilight[next][0])
        ++next;
    const auto& [low, from] = twilight[next - 1];
    const auto& [high, to] = twilight[next];
    return static_cast<float>(std::pow(10.0, from + (to - from) * (deg - low) / (high - low)));
}

Moon::Moon(const Vector3f& to_sun, float cloud_cover)
    : to_moon(-to_sun),
      through_clouds(std::max(0.0F, 1 - cloud_cover * cloud_cover)) {
    through_clouds *= through_clouds * through_clouds;
    // Allen, "Astrophysical Quantities": 0.27 lx from the zenith; air takes more of it low down.
    const float up = smooth_step(0, 0.30F, to_moon.z());
    light = Color(0.93F, 1.0F, 1.16F) * (0.27F * lux * up * (1 - cloud_cover * cloud_cover));
}

Color night_glow(const Vector3f& direction, const Moon& moon, float cloud_cover, float lamplight) {
    const float up = std::max(direction.z(), 0.0F);
    const float low = (1 - up) * (1 - up);
    // Falchi et al., "The new world atlas of artificial night sky brightness", 2016: some mcd/m2
    // over a town's streets; ten times as much, so that pictures show where the sky begins. Clouds
    // send back several times as much as clear air.
    const float town = 0.022F * lux * lamplight * (1 + 1.8F * low * low) * (1 + 1.2F * cloud_cover);
    const Color warm = mix(Color(0.80F, 0.98F, 1.45F), Color(1.22F, 0.97F, 0.72F), low * 0.7F);
    const float air = 0.09F / pi * (1.1F - 0.4F * up);
    return warm * town + moon.light * Color(0.62F, 0.95F, 1.75F) * air;
}

float lamplight_at(float illuminance) {
    return 1 - rise(40, 700, illuminance);
}

float headlamps_at(float illuminance, float rain) {
    return std::max(1 - rise(2500, 12000, illuminance), smooth_step(0, 0.3F, rain));
}

float exposure_for(float light) {
    const float illuminance = light * pi / lux;
    return mix(0.42F, 1.05F, rise(7000, 32000, illuminance)) / light;
}

}  // namespace reprise::render
