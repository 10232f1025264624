#pragma once

#include <vector>

#include "ground/mesh/ground.h"
#include "towns/check/criterion.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// What a town promises about the feet of the things in it: plants, furniture and signal heads
/// stand within 25 cm of the ground (fences, walls, hedges and benches with both ends), and every
/// building has a door within 30 cm of the ground before it, and no wall whose foundation does not
/// reach the ground. `ground` is build_ground(town).
std::vector<Criterion> check_standing(const world::TownT& town, const ground::GroundMesh& ground);

}  // namespace reprise::towns
