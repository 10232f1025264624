#pragma once

#include "ground/mesh/ground_builder.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// How far kerbs reach below the road: no gap on slopes. [m]
inline constexpr double kerb_depth = 0.3;

/// Sidewalks and walking areas with their kerbs.
void add_slabs(const world::TownT& town, GroundBuilder& ground);

}  // namespace reprise::ground
