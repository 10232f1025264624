#pragma once

#include <cstdint>

#include "world/tick_generated.h"

namespace reprise::kernel {

/// What hit an actor with mass in a tick. Two actors with mass that hit each other make two.
struct Impact {
    std::uint32_t actor = 0;
    std::uint32_t other = 0;  ///< 0: the static world
    double impulse = 0;       ///< [N s] size of the sum of the normal impulses in the tick
};

/// A car without mass that has become a vehicle with mass, because something hit it.
struct Wreck {
    std::uint32_t id = 0;
    double speed = 0;      ///< [m/s] before it was hit
    std::uint32_t by = 0;  ///< who hit it
};

/// Whoever sat in it stands on the brake, and pulls the hand brake when it stands. `speed` [m/s] of
/// the last tick.
inline world::Control wreck_control(std::uint32_t actor, double speed) {
    constexpr double standing = 0.3;  // [m/s]
    const bool stands = speed < standing;
    return {0, stands ? 0.0 : 1.0, 0, actor, 0, stands, false};
}

}  // namespace reprise::kernel
