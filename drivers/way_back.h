#pragma once

#include <cstdint>

#include "drivers/control/ego.h"
#include "drivers/road_map.h"

namespace reprise::drivers {

/// Off every road: where to steer, to come onto the nearest lane the way that it leads. `tries`:
/// how often what stands in between held it; then it goes at a slant, four times ahead along the
/// lane, four times back. As in Control; straight on where no lane is within 300 m. O(lanes near).
double steer_back(const RoadMap& map, const Ego& ego, std::uint32_t tries);

}  // namespace reprise::drivers
