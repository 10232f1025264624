#pragma once

#include <vector>

#include "world/town.h"

namespace reprise::traffic {

/// [lane] Does a lane of another road run over it outside of junctions, so near that who drives on
/// the one is in the way of who drives on the other? Networks have such places where roads leave a
/// junction at a sharp angle; to SUMO there is nothing.
std::vector<bool> lanes_that_cross(const world::TownT& town);

}  // namespace reprise::traffic
