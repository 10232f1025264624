#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Fills town.spawn_points: for vehicles some 25 m apart on driving lanes, 12 m behind junctions
/// and 15 m before the lane's end; for walkers some 20 m apart on sidewalks; none where something
/// stands.
void place_spawn_points(PlacementContext& context);

}  // namespace reprise::towns
