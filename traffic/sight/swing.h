#pragma once

#include <span>

#include "traffic/cars/car.h"
#include "traffic/sight/footprints.h"
#include "world/town.h"

namespace reprise::traffic {

constexpr double pull_out_time = 2.5;  ///< [s]
constexpr double slow_pull_out = 1.4;  ///< [m/s] of one who stands close behind what he passes

/// Pulling out from where it stands to `aside` [m] left of its lane's middle, at no more than that
/// pace [m/s], would its side or corner touch anything? `at` is its bumper on its lane.
bool swings_into_any(const Car& car,
                     const world::LaneT& lane,
                     const world::LaneProjection& at,
                     double aside,
                     double pace,
                     std::span<const Footprint> footprints);

}  // namespace reprise::traffic
