#pragma once

#include <vector>

#include "towns/import/right_of_way.h"
#include "towns/maps/map_shapes.h"

namespace reprise::towns {

/// The signs of an OpenStreetMap map: nodes on their road (MapShapes::signs), each for traffic that
/// passes it towards a junction within 50 m. A tag `direction` says along or against the way;
/// without it the nearer junction counts. Nodes in the middle of a junction are ignored, but for
/// stop signs tagged `stop=all`, which are for all roads there. In the map's order.
std::vector<LaneSign> lane_signs(const std::vector<MapShape>& signs, const world::TownT& town);

}  // namespace reprise::towns
