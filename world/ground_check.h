#pragma once

#include <vector>

#include "world/criterion.h"
#include "world/ground.h"

namespace reprise::world {

/// What a town's ground promises to those who drive on it: there is road within 5 cm under every
/// driving lane and turning path and under the wheels beside it; no kerb within 0.9 m of a centre
/// line; no hole in the ground; lanes join without a gap. `ground` is build_ground(town).
/// Town 1: 50 ms.
std::vector<Criterion> check_ground(const TownT& town, const GroundMesh& ground);

/// Height of the road under the left and right wheels is that of the centre line there, less or
/// more what the road banks: both wheels' mean within the limit, and a bank of 12 % at most.
inline constexpr double steepest_bank = 0.12;

}  // namespace reprise::world
