#pragma once

#include <cstdint>
#include <vector>

#include "world/lanes/route.h"
#include "world/town_generated.h"

namespace reprise::world {

/// Of a chain of lanes, each a link or a neighbour ahead of the last one: the stretches and the
/// commands. A junction is announced 25 m before it, and its command ends where the car leaves it.
/// Junctions less than 15 m apart, as in a roundabout, are one: the command is the sum of their
/// turns. Where a street has but one way on, nothing is announced. O(points).
Route make_route(const TownT& town,
                 const std::vector<std::uint32_t>& lanes,
                 double from_s,
                 double to_s);

}  // namespace reprise::world
