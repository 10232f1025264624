#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Street lights every 30 m on alternating sides; bus stops some 400 m apart.
void place_street_lights(PlacementContext& context);
void place_bus_stops(PlacementContext& context);

/// Benches, bins, bollards, hydrants and mailboxes on the outer part of sidewalks, so that walkers
/// keep 1.2 m; telephone poles along roads without sidewalks and along some streets.
void place_small_furniture(PlacementContext& context);

}  // namespace reprise::towns
