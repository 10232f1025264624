#include "render/optics/pixel_noise.h"

#include <algorithm>
#include <cmath>

#include "world/external/sensor_attributes.h"

namespace reprise::render {

namespace {

constexpr double few = 30;  // [electrons] up to which they are counted one by one

std::uint64_t seed_of(const world::SensorSpec& spec) {
    return static_cast<std::uint64_t>(world::attribute(spec, "noise_seed"));
}

}  // namespace

PixelNoise::PixelNoise(const world::SensorSpec& spec, std::uint64_t tick, double most)
    : most_(most),
      full_(world::attribute(spec, "full_well") * 100 / world::attribute(spec, "iso")),
      read_(world::attribute(spec, "read_noise")),
      prnu_(world::attribute(spec, "prnu")),
      dsnu_(world::attribute(spec, "dsnu")),
      steps_(std::pow(2.0, world::attribute(spec, "bit_depth")) - 1),
      moment_(seed_of(spec), spec.name, tick),
      forever_(seed_of(spec), spec.name, ~std::uint64_t{0}) {}

/// Poisson's distribution: by its inverse, or where that is long as a normal one.
double PixelNoise::arrived(double mean, std::uint64_t pixel) const {
    if (mean >= few)
        return std::max(0.0, std::round(mean + std::sqrt(mean) * moment_.normal(pixel, 0)));
    const double wanted = moment_.uniform(pixel, 0);
    double chance = std::exp(-mean);
    double sum = chance;
    int count = 0;
    while (sum < wanted && count < 4 * few) {
        ++count;
        chance *= mean / count;
        sum += chance;
    }
    return count;
}

float PixelNoise::measured(float light, std::uint64_t pixel) const {
    double mean = std::min(static_cast<double>(light) / most_, 1.5) * full_;
    double offset = 0;
    if (prnu_ > 0)
        mean *= std::max(0.0, 1 + prnu_ * forever_.normal(pixel, 0));
    if (dsnu_ > 0)
        offset = dsnu_ * forever_.normal(pixel, 1);
    double electrons = std::min(arrived(mean, pixel), full_) + offset;
    if (read_ > 0)
        electrons += read_ * moment_.normal(pixel, 1);
    const double step = std::clamp(std::round(electrons / full_ * steps_), 0.0, steps_);
    return static_cast<float>(step / steps_ * most_);
}

}  // namespace reprise::render
