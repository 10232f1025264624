#pragma once

#include "towns/furnish/land.h"

namespace reprise::towns {

/// Street lights every 30 m on alternating sides; bus stops some 400 m apart.
void place_street_lights(Land& land);
void place_bus_stops(Land& land);

/// Benches, bins, bollards, hydrants and mailboxes on the outer part of sidewalks, so that walkers
/// keep 1.2 m; telephone poles along roads without sidewalks and along some streets.
void place_small_furniture(Land& land);

}  // namespace reprise::towns
