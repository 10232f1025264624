#pragma once

#include <optional>
#include <vector>

#include "walkers/map/walk_map.h"
#include "world/town.h"

namespace reprise::walkers {

/// Where the ways of a town are found. All are borrowed.
struct StreetMaps {
    const WalkMap& pavement;
    const WalkMap& streets;
    const world::TownT& town;
    const world::LaneMap& lanes;
};

/// The way of somebody who crosses the road anywhere: by the pavement as everybody, but for the
/// places where a way by the streets would leave it; there it goes straight over to the other side.
/// (Shortest ways would be drawn out along the road.) At crossings and in junctions he goes as
/// everybody does. `from` and `goal` are on the streets' map; `road_cost`: metres of sidewalk that
/// he goes for one of road.
std::optional<std::vector<WalkMap::Step>> way_across(const StreetMaps& maps,
                                                     const WalkMap::Place& from,
                                                     const WalkMap::Place& goal,
                                                     double road_cost);

}  // namespace reprise::walkers
