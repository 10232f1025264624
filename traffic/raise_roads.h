#pragma once

#include <string>
#include <vector>

#include "traffic/map_shapes.h"

namespace reprise::traffic {

/// What became of the bridges and tunnels of a map.
struct RaisedRoads {
    int crossings = 0;    ///< places where one road now passes over another
    double length = 0;    ///< [m] of roads that are not at height 0 any more
    double steepest = 0;  ///< [m/m] slope of a road for cars
    int steep = 0;        ///< roads for cars, steeper than 12 %
};

/// Gives heights to a flat network in which roads of one map cross at several layers: 6 m from one
/// level to the next, ramps of at most 8 % where roads are long enough for it, every junction
/// level. Roads that need no height keep every byte. `ways` have a layer (MapShapes::ways).
RaisedRoads raise_roads(std::string& network, const std::vector<MapShape>& ways);

}  // namespace reprise::traffic
