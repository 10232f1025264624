#pragma once

#include "ground/mesh/ground_builder.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// How far the terrain lies below the road, where the road is the lowest one. [m]
inline constexpr double terrain_depth = 0.05;

/// A height field under all that `ground` already holds, and beyond: 60 m and below all buildings
/// and trees where the roads are flat, else 190 m whatever stands there. It never rises above
/// terrain_depth below any road: whoever leaves the road lands on it.
void add_terrain(const world::TownT& town, GroundBuilder& ground);

}  // namespace reprise::ground
