#pragma once

#include <cmath>

namespace reprise::world {

/// Length of one walk cycle (two steps), which is what a walker's phase counts. [m]; speed in m/s,
/// height of the walker in m.
/// Boulic, Thalmann and Thalmann, "A global human walking model with real-time kinematic
/// personification", The Visual Computer 6 (1990): 1.346 sqrt(v) in leg lengths, v in leg lengths
/// per second; the leg is 0.53 of the height (Winter, "Biomechanics and Motor Control of Human
/// Movement", 4th ed., ch. 4).
inline double walk_cycle_length(double speed, double height) {
    constexpr double leg_share = 0.53;
    const double leg = leg_share * height;
    return 1.346 * std::sqrt(speed / leg) * leg;
}

}  // namespace reprise::world
