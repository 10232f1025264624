#pragma once

#include <vector>

#include "ground/mesh/ground.h"
#include "towns/check/criterion.h"
#include "world/digest.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// What a town's ground promises to those who drive on it: there is road within 5 cm under every
/// driving lane and turning path and under the wheels 0.8 m beside it, banked by 12 % at most; no
/// kerb within 0.9 m of a centre line; no splinter of sidewalk left over between paths; no hole in
/// the ground; lanes join without a gap. `ground` is build_ground(town). Town 1: 50 ms.
std::vector<Criterion> check_ground(const world::TownT& town, const ground::GroundMesh& ground);

/// Of every vertex, triangle and surface: equal digests mean equal meshes.
world::Digest128 digest_of(const ground::GroundMesh& mesh);

}  // namespace reprise::towns
