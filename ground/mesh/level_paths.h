#pragma once

#include "world/town_generated.h"

namespace reprise::ground {

/// Makes the turning paths of each junction agree on one height wherever they cross. Converters
/// give every path its own height, a line from one end to the other, so that paths which cross on a
/// banked or sloping junction may pass 20 cm above each other (measured on CARLA's Town04); no road
/// can follow both.
/// The ends stay where they are; between them the change is as smooth as it can be. Paths that
/// agree already, and lanes outside of junctions, keep every bit. Town04: 30 ms.
void level_paths(world::TownT& town);

}  // namespace reprise::ground
