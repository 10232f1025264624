#pragma once

#include <vector>

#include "towns/check/criterion.h"
#include "towns/check/things_in_town.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Half the width of the way along the middle of a sidewalk in which nothing stands. [m]
inline constexpr double walker_clearance = 0.3;

/// What a town promises about the things in it: every group of signals has a head that shows it,
/// actors can start at every spawn point, and no building, plant or piece of furniture stands where
/// cars drive (0.9 m either side of a centre line), in the middle of a sidewalk (walker_clearance)
/// or where the body of a bus passes in bends (ground/swept_area.h).
std::vector<Criterion> check_furniture(const world::TownT& town);

}  // namespace reprise::towns
