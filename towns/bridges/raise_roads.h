#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "towns/bridges/height_faults.h"
#include "towns/maps/map_shapes.h"

namespace reprise::towns {

/// What became of the bridges and tunnels of a map.
struct RaisedRoads {
    int crossings = 0;    ///< places where one road now passes over another
    double length = 0;    ///< [m] of roads that are not at height 0 any more
    double steepest = 0;  ///< [m/m] slope of a road for cars
    int steep = 0;        ///< roads for cars, steeper than 12 %
    /// How many bridges and tunnels stay flat, each for the first fault that it would make.
    std::map<HeightFault::Kind, int> flat;
};

/// What is wrong with a network that was raised; nothing wrong: it is taken.
using FindFaults = std::function<std::vector<HeightFault>(const std::string& network)>;

/// Gives heights to a flat network in which roads of one map cross at several layers: 6 m from one
/// level to the next, ramps of at most 8 % where roads are long enough for it, every junction
/// level. Roads that need no height keep every byte. `ways` have a layer (MapShapes::ways).
/// Bridges and tunnels at which `find_faults` finds a fault stay flat, all of them at worst: their
/// roads then cross the others at one height.
RaisedRoads raise_roads(std::string& network,
                        const std::vector<MapShape>& ways,
                        const FindFaults& find_faults);

}  // namespace reprise::towns
