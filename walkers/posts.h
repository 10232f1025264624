#pragma once

#include <span>
#include <vector>

#include "walkers/map/walk_map.h"
#include "walkers/steering.h"
#include "world/obstacle.h"

namespace reprise::walkers {

/// Poles, trunks and bollards that a walk map comes so close to that its edge keeps no shoulder off
/// them: an outline may be a cell off, and around something thin that is much. As round bodies.
/// One question to the map for each obstacle: 2 us.
std::vector<Body> posts_beside(const WalkMap& map, std::span<const world::Obstacle> obstacles);

}  // namespace reprise::walkers
