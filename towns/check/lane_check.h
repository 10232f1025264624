#pragma once

#include <vector>

#include "towns/check/criterion.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// What a town promises about its lanes for cars, as they are drawn: at most 0.5 % of their length
/// between junctions lies under a lane of another road at the same height (roads that meet are
/// free to touch near their junction, and both directions may share one lane); none is drawn more
/// than 1.25 times as long as SUMO counts it, or the other way round; none folds back over itself
/// (sharpest_turn). O(lanes near).
std::vector<Criterion> check_lanes(const world::TownT& town);

}  // namespace reprise::towns
