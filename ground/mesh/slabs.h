#pragma once

#include "ground/mesh/ground_builder.h"

namespace reprise::ground {

/// Half of what a car needs: 1.9 m of car and 0.3 m of air on both sides. Road is at least this
/// wide on both sides of every path, and no slab comes nearer. [m]
inline constexpr double car_clearance = 1.25;

/// Sidewalks and walking areas with their kerbs.
void add_slabs(const world::TownT& town, GroundBuilder& ground);

}  // namespace reprise::ground
