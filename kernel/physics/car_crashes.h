#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kernel/physics/displaced.h"
#include "world/traffic_generated.h"

namespace reprise::kernel {

/// Cars without mass of which one drives into the other in a tick; the lower id first, sorted.
using CarCrashes = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Whom the scenario sends into another car: one that holds its speed or follows a trajectory
/// reacts to nothing, and nothing else would stop the two from going through each other.
///
/// MUST    find each pair of which one is the scenario's, one moves, and whose boxes are more than
///         `deepest_scrape` in each other on their way through the tick.
/// ASSUMES that cars of the demand's keep clear of each other: SUMO sees to that.
/// GOES    by x, so that each of the scenario's cars looks at the few around it.
/// KEEPS   nothing; a pure function of two ticks. About 0.2 us a car.
CarCrashes crashes_among(std::span<const world::CarState> last,
                         std::span<const world::CarState> next,
                         const Displaced& displaced);

/// [m] Less is none: SUMO rounds places, and its cars cut bends.
constexpr double deepest_scrape = 0.1;

}  // namespace reprise::kernel
