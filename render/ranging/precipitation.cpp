#include "render/ranging/precipitation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace reprise::render {

namespace {

constexpr double table_step = 0.05;       // [m] of the table
constexpr double least_diameter = 0.05;   // [mm] what is smaller is fog
constexpr double farthest_speck = 100;    // [m] no drop is noticed there
constexpr std::uint32_t most_drawn = 32;  // in one beam

/// Straight through the surface of a drop with this refractive index, and back.
double fresnel_of(double index) {
    const double r = (index - 1) / (index + 1);
    return r * r;
}

double beam_mm(const Pulse& pulse, double range) {
    return 1000 * pulse.divergence * range;
}

/// The smallest diameter that is noticed at this range. [mm]; infinity: none.
double noticed_from(const Hydrometeors& drops, const Pulse& pulse, double range) {
    const double seen = overlap(range);
    if (!(seen > 0))
        return std::numeric_limits<double>::infinity();
    const double share = pulse.least_power * range * range *
                         std::exp(2 * pulse.extinction * range) / (drops.reflectivity * seen);
    if (share > 1)
        return std::numeric_limits<double>::infinity();
    return std::max(least_diameter, beam_mm(pulse, range) * std::sqrt(share));
}

}  // namespace

double overlap(double range) {
    return std::clamp((range - blind_until) / (sighted_from - blind_until), 0.0, 1.0);
}

Hydrometeors rain_drops(double mm_per_hour) {
    if (!(mm_per_hour > 0))
        return {};
    return {8000,
            4.1 * std::pow(mm_per_hour, -0.21),
            fresnel_of(1.328),  // water at 905 nm
            0.312e-3 * std::pow(mm_per_hour, 0.67)};
}

Hydrometeors snow_flakes(double mm_per_hour) {
    if (!(mm_per_hour > 0))
        return {};
    Hydrometeors flakes{7600 * std::pow(mm_per_hour, -0.87),
                        2.55 * std::pow(mm_per_hour, -0.48),
                        fresnel_of(1.3031),  // ice
                        0};
    // Each takes twice its disc's light from the beam: pi/4 * 2 * integral of D^2 N(D).
    flakes.extinction = std::numbers::pi / 2 * flakes.intercept * 2 /
                        (flakes.slope * flakes.slope * flakes.slope) * 1e-6;
    return flakes;
}

Precipitation::Precipitation(const Hydrometeors& drops, const Pulse& pulse)
    : drops_(drops),
      pulse_(pulse),
      expected_{0} {
    if (!(drops.intercept > 0))
        return;
    const double end = std::min(pulse.range, farthest_speck);
    for (std::size_t i = 0; static_cast<double>(i) * table_step < end; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * table_step;
        const double radius = beam_mm(pulse, middle) / 2000;
        const double density = drops.intercept / drops.slope *
                               std::exp(-drops.slope * noticed_from(drops, pulse, middle));
        expected_.push_back(expected_.back() +
                            density * std::numbers::pi * radius * radius * table_step);
    }
}

double Precipitation::expected(double range) const {
    const double place = std::max(range, 0.0) / table_step;
    const auto last = static_cast<double>(expected_.size() - 1);
    if (place >= last)
        return expected_.back();
    const auto below = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(below);
    return expected_[below] + share * (expected_[below + 1] - expected_[below]);
}

double Precipitation::range_of(double expected) const {
    const auto above = std::upper_bound(expected_.begin(), expected_.end(), expected);
    if (above == expected_.end())
        return static_cast<double>(expected_.size() - 1) * table_step;
    const auto index = static_cast<std::size_t>(above - expected_.begin());
    const double from = expected_[index - 1];
    return (static_cast<double>(index - 1) + (expected - from) / (*above - from)) * table_step;
}

double Precipitation::power(double range, double diameter) const {
    const double share = std::min(diameter / beam_mm(pulse_, range), 1.0);
    return drops_.reflectivity * overlap(range) * share * share *
           std::exp(-2 * pulse_.extinction * range) / (range * range);
}

std::optional<Speck> Precipitation::strongest(double range,
                                              const world::SensorNoise& noise,
                                              std::uint64_t ray,
                                              std::uint32_t first_draw) const {
    const double most = expected(range);
    if (!(most > 0))
        return std::nullopt;
    std::optional<Speck> best;
    // Waiting times of a Poisson process: the next drop's place among those expected.
    double passed = 0;
    for (std::uint32_t drop = 0; drop < most_drawn; ++drop) {
        passed -= std::log(1 - noise.uniform(ray, first_draw + 2 * drop));
        if (passed >= most)
            break;
        const double place = range_of(passed);
        const double above = -std::log(1 - noise.uniform(ray, first_draw + 2 * drop + 1));
        const double found =
            power(place, noticed_from(drops_, pulse_, place) + above / drops_.slope);
        if (found >= pulse_.least_power && (!best || found > best->power))
            best = Speck{place, found};
    }
    return best;
}

}  // namespace reprise::render
