#pragma once

#include <cstdint>

#include "ground/paint/paint.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// Arrows before the end of a lane that show where one may go from it: only where lanes differ,
/// that is where a road with several lanes in this direction leads to more than one turn, as road
/// authorities do. `centre` is the lane's clean line. One arrow 6 m before the stop line, and a
/// second one 24 m before the first where there is room.
void paint_turn_arrows(const world::TownT& town,
                       std::uint32_t lane,
                       const Line& centre,
                       Paint& paint);

}  // namespace reprise::ground
