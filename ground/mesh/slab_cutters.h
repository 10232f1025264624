#pragma once

#include <vector>

#include "world/geometry2d.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// Something that a sidewalk must not cover.
struct SlabCutter {
    world::Loop loop;
    world::Box box;
    double z = 0;              ///< [m] of its middle
    bool is_crossing = false;  ///< else cars drive over it
};

/// What the lanes of a town keep clear of sidewalks: the width of every lane and path, the corners
/// between a lane and the path that leaves it sideways, and crossings.
std::vector<SlabCutter> slab_cutters(const world::TownT& town);

}  // namespace reprise::ground
