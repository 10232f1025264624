#pragma once

#include <cstdint>
#include <vector>

#include "ground/mesh/surface_height.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// What lies within one junction. Indices in town.lanes, ascending.
struct JunctionParts {
    std::vector<std::uint32_t> paths;  ///< internal lanes
    std::vector<std::uint32_t> crossings;
};

/// Does a vehicle (of any kind) pass a junction on it?
bool is_inside_junction(const world::TownT& town, const world::LaneT& lane);

/// One for each junction, in their order.
std::vector<JunctionParts> parts_of_junctions(const world::TownT& town);

/// The height of a junction's road: that of its paths.
SurfaceHeight height_of_junction(const world::TownT& town,
                                 std::uint32_t junction,
                                 const JunctionParts& parts);

}  // namespace reprise::ground
