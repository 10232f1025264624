#pragma once

#include <cstdint>

namespace reprise::kernel {

/// What hit an actor with mass in a tick. Two actors with mass that hit each other make two.
struct Impact {
    std::uint32_t actor = 0;
    std::uint32_t other = 0;  ///< 0: the static world
    double impulse = 0;       ///< [N s] size of the sum of the normal impulses in the tick
};

}  // namespace reprise::kernel
