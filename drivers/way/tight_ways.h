#pragma once

#include <cstdint>
#include <span>

#include "world/town.h"

namespace reprise::drivers {

/// Does the way over these lanes, in driving order, turn so sharply somewhere that a car would
/// leave the road there, whatever it does: by more than 125 degrees within 8 m? At full lock it
/// turns by about 115. As where two roads that part at an acute angle are drawn as meeting in a
/// point.
bool is_tight(const world::TownT& town, std::span<const std::uint32_t> lanes);

}  // namespace reprise::drivers
