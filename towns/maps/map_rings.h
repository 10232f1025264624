#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

/// The outlines of an OpenStreetMap map's multipolygons that are drawn as several ways, put
/// together.
struct MapRings {
    int open = 0;     ///< multipolygons of which a part does not close: left out
    std::string osm;  ///< each outline as one closed way with the tags of its relation; "": none
};

/// Of buildings and of land that a town shows. polyconvert, which knows outlines of one way only,
/// reads `osm` along with the map: nodes are named, not repeated. `map` is plain XML, and is looked
/// through twice, in little memory; `called` is how the user calls it. The same map gives the same
/// rings, whatever the order of its relations. Throws world::Error when libosmium refuses the map.
MapRings read_rings(const std::filesystem::path& map, const std::string& called);

}  // namespace reprise::towns
