#pragma once

#include "ground/mesh/ground.h"
#include "towns/check/criterion.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Does the ground go on where a street ends, so that who leaves it there does not fall? The
/// deepest drop within 2 m beyond a lane for cars that nothing leads on from, or onto, unless one
/// turns round there: 1 m at most.
/// `ground` is build_ground(town).
Criterion check_ends(const world::TownT& town, const ground::GroundMesh& ground);

}  // namespace reprise::towns
