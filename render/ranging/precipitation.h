#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "world/external/sensor_noise.h"

namespace reprise::render {

/// Drops or flakes in the air: diameters are distributed as intercept * e^(-slope D).
struct Hydrometeors {
    double intercept = 0;     ///< [1 / (m^3 mm)]; 0: none
    double slope = 1;         ///< [1/mm]
    double reflectivity = 0;  ///< share of light that comes straight back
    double extinction = 0;    ///< [1/m]
};

/// Rain of so many mm/h. Marshall and Palmer (1948); extinction .312 R^.67 per km (Weber et al.,
/// 2015), which two surfaces' worth of each drop's disc confirms within 17 %.
Hydrometeors rain_drops(double mm_per_hour);

/// Snow whose water is so many mm/h. Gunn and Marshall (1958), of the melted flakes.
Hydrometeors snow_flakes(double mm_per_hour);

/// What stands in a pulse's way. Powers count in those of a white surface, met straight on, one
/// metre away.
struct Pulse {
    double divergence = 3e-3;  ///< [rad] of the whole beam
    double least_power = 0;    ///< what a receiver notices
    double extinction = 0;     ///< [1/m] of all that is in the air
    double range = 100;        ///< [m]
};

/// A drop that a receiver notices.
struct Speck {
    double range = 0;  ///< [m]
    double power = 0;
};

/// The strongest return from drops or flakes before a surface: after LISA (Kilic et al., 2021),
/// where each drop in the beam is drawn, with place and diameter, and sends back
/// reflectivity * min((D / beam)^2, 1) e^(-2 a r) / r^2. Of ten thousand drops in a beam one at
/// most is noticed: only those are drawn here, which is the same distribution.
class Precipitation {
  public:
    Precipitation(const Hydrometeors& drops, const Pulse& pulse);

    /// How many noticeable ones are expected up to there. [m]
    double expected(double range) const;

    /// The strongest up to there; none mostly.
    std::optional<Speck> strongest(double range,
                                   const world::SensorNoise& noise,
                                   std::uint64_t ray,
                                   std::uint32_t first_draw) const;

  private:
    double power(double range, double diameter) const;
    double range_of(double expected) const;

    Hydrometeors drops_;
    Pulse pulse_;
    std::vector<double> expected_;  ///< up to multiples of a step
};

/// Receivers see nothing nearer than this, and all from the second one on. [m] Bijelic et al.
inline constexpr double blind_until = 0.9;
inline constexpr double sighted_from = 1.0;

/// The share of light from a range that enters the receiver.
double overlap(double range);

}  // namespace reprise::render
