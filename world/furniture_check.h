#pragma once

#include <vector>

#include "world/criterion.h"
#include "world/town_generated.h"

namespace reprise::world {

/// What a town promises about the things in it: every group of signals has a head that shows it,
/// actors can start at every spawn point, and no building, plant or piece of furniture stands where
/// cars drive (0.9 m either side of a centre line) or in the middle of a sidewalk (0.3 m).
std::vector<Criterion> check_furniture(const TownT& town);

}  // namespace reprise::world
