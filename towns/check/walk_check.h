#pragma once

#include "towns/check/criterion.h"
#include "walkers/map/walk_map.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Of 400 pairs of places on a town's sidewalks, spread evenly, at least 95 % are connected. Only
/// the largest part of them that the network itself joins counts, by walking areas and crossings:
/// motorway maps have strips of sidewalk here and there. Where it joins none, all count. Says how
/// much of the ways lies on roads, and how many sidewalks that part has. A town without passes.
towns::Criterion check_walking(const world::TownT& town, const walkers::WalkMap& map);

}  // namespace reprise::towns
