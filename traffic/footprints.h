#pragma once

#include <filesystem>

#include "traffic/place.h"

namespace reprise::traffic {

/// What became of the areas of an OpenStreetMap map.
struct FootprintReport {
    int buildings = 0;  ///< placed
    int plots = 0;      ///< placed
    int cut = 0;        ///< buildings that were cut back to the edge of a road
    int on_roads = 0;   ///< buildings left out: they stand on a road
    int broken = 0;     ///< areas left out: their outline crosses itself, or has no area
};

/// Adds the buildings and the parks, waters, woods and car parks of a map to the place, as far as
/// they lie within 300 m of a road. SUMO's polyconvert reads and projects them: the same way as
/// netconvert did with the roads. Heights are those of the map (height, building:levels), or usual
/// ones for the kind. `map` and `network` are files in the folder `scratch`; `roads` is what was
/// read out of the network. Throws world::Error when polyconvert fails.
FootprintReport place_footprints(const std::string& map,
                                 const std::string& network,
                                 const world::TownT& roads,
                                 const std::filesystem::path& scratch,
                                 Place& place);

}  // namespace reprise::traffic
