#pragma once

#include "traffic/place.h"
#include "world/town_generated.h"

namespace reprise::traffic {

/// Fills a town with all that stands in it: signal heads, signs, buildings, plants, furniture,
/// plots and spawn points. What the place knows is kept; the rest is drawn from the town's name, so
/// that the same network makes the same town. Lanes, links, signals and junctions must be there.
/// Town 1: 100 ms.
void place_scenery(world::TownT& town, const Place& place);

}  // namespace reprise::traffic
