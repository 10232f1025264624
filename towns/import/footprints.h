#pragma once

#include <vector>

#include "towns/maps/map_shapes.h"
#include "towns/network/place.h"

namespace reprise::towns {

/// What became of the areas of an OpenStreetMap map.
struct FootprintReport {
    int buildings = 0;  ///< placed
    int plots = 0;      ///< placed
    int cut = 0;        ///< buildings that were cut back to the edge of a road
    int on_roads = 0;   ///< buildings left out: they stand on a road
    int filled = 0;     ///< courtyards (inner rings) that were built over: outlines have no holes
    int broken = 0;     ///< areas left out: their outline crosses itself, or has no area
};

/// Adds the buildings and the parks, waters, woods and car parks among `areas` to the place, as far
/// as they lie within 300 m of a road. Heights are those of the map (height, building:levels), or
/// usual ones for the kind. `roads` is what was read out of the network.
FootprintReport place_footprints(const std::vector<MapShape>& areas,
                                 const world::TownT& roads,
                                 Place& place);

}  // namespace reprise::towns
