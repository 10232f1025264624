#pragma once

#include "world/town_generated.h"

namespace reprise::traffic {

/// Fills town.buildings and town.trees: what stands beside the roads. A network says nothing of it,
/// so it is drawn from the town's name: rows of houses along the roads, trees in the gaps.
/// Buildings stay 3 m clear of everything that is walked or driven on and of each other, trunks
/// 1.5 m. Lanes and junctions must be there. Town 1: 30 ms.
void place_scenery(world::TownT& town);

}  // namespace reprise::traffic
