#pragma once

#include <cstdint>

#include "world/tick.h"

namespace reprise::kernel {

inline constexpr double sensing_range = 100;  // [m]

/// Who is next in the straight corridor of a vehicle's width.
struct Ahead {
    double gap = sensing_range;  ///< [m] from bumper to bumper, 0 where they touch
    std::uint32_t actor = 0;     ///< a vehicle or a car; 0: nobody within the range
};

Ahead nearest_ahead(const world::VehicleState& vehicle, const world::TickDraft& next);

}  // namespace reprise::kernel
