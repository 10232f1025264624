#pragma once

#include <vector>

#include "towns/furnish/clearance.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// The body of a bus in bends and on its ways across junctions, every 0.75 m of its way: there it
/// does not lie along its lane, is wider than it, and its tail swings out over the kerb. Its bumper
/// drives along the lanes, its rear axle where the bumper has been, as traffic moves it
/// (traffic/cars/trail.h). O(metres of lanes).
std::vector<Footprint> bus_bodies(const world::TownT& town);

}  // namespace reprise::towns
