#pragma once

#include "ground/mesh/ground_builder.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// Sidewalks and walking areas with their kerbs.
void add_slabs(const world::TownT& town, GroundBuilder& ground);

}  // namespace reprise::ground
