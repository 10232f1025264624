#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "towns/maps/map_area.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Something that an OpenStreetMap map shows, in the coordinates of the network made of it.
struct MapShape {
    std::string id;
    Tags tags;
    std::vector<world::Vec3> line;  ///< [m] z is 0; areas end where they begin
};

/// What a town takes from an OpenStreetMap map beside the network that netconvert makes of it. Each
/// list is in polyconvert's order, which is that of ids.
struct MapShapes {
    std::vector<MapShape> areas;  ///< buildings and plots, near the roads
    std::vector<MapShape> ways;   ///< bridges and tunnels of roads: layer_of() is not 0
    std::vector<MapShape> signs;  ///< of one point each: highway=stop or highway=give_way
    int open_areas = 0;           ///< multipolygons with an outline that does not close
    std::vector<Eigen::Vector3d> crossings;  ///< [m] highway=crossing; z is 0
};

/// SUMO's polyconvert reads and projects the map: the same way as netconvert did with the roads.
/// `map` and `network` are files in the folder `scratch`; `called` is how the user calls the map.
/// What the map cuts off, as extracts do, is left out. Throws world::Error when it fails.
MapShapes read_shapes(const std::string& map,
                      const std::string& network,
                      const std::filesystem::path& scratch,
                      const std::string& called);

/// How a way lies in relation to those that it crosses, from -5 to 5: what the map says, else 1 for
/// a bridge and -1 for a tunnel.
int layer_of(const Tags& tags);

}  // namespace reprise::towns
