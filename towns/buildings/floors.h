#pragma once

#include <optional>

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Height of the ground floor of a building whose front is at -y: a step over the ground before the
/// door, in the middle of the front. `road_z`: of the road beside it; the floor in a level town.
/// None: the ground falls or rises by more than 1.2 m from there under the footprint, or by more
/// than 1 m along the front. [m]
std::optional<double> floor_on(const GroundHeights& ground_heights,
                               const Footprint& footprint,
                               double road_z);

/// Moves a drawn building to the height of its street side, where its door is. It stays where it is
/// in a level town and beyond the terrain.
void set_floor(const PlacementContext& context, world::DrawnBuildingT& drawn);

}  // namespace reprise::towns
