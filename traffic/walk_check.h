#pragma once

#include "traffic/walk_map.h"
#include "world/criterion.h"
#include "world/town_generated.h"

namespace reprise::traffic {

/// Of 400 pairs of places on a town's sidewalks, spread evenly, at least 95 % are connected; says
/// how much of the ways lies on roads, as where there are no crossings. A town without sidewalks
/// passes.
world::Criterion check_walking(const world::TownT& town, const WalkMap& map);

}  // namespace reprise::traffic
