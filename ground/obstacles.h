#pragma once

#include <vector>

#include "world/obstacle.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// Buildings (drawn ones in convex pieces), trunks, the wood of bushes, poles, street furniture and
/// parked vehicles. Sorted by x, then by their order in the town. O(things in the town).
std::vector<world::Obstacle> obstacles_of(const world::TownT& town);

}  // namespace reprise::ground
