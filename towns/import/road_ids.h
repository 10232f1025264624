#pragma once

#include <string>

#include "towns/import/signal_sites.h"
#include "towns/maps/opendrive.h"

namespace reprise::towns {

/// What of which roads of the map the lanes of a network are.
struct RoadIds {
    std::string network;  ///< the network, whose lanes say so: <param key="road">
    int lanes = 0;        ///< for cars and walkers, outside of junctions, that know their road
    int unknown = 0;      ///< that do not
};

/// `network` was made of the map with --output.original-names, which tells roads and lanes;
/// `roads` is what it reads as. Where along the road a lane lies is measured against the road's
/// reference line.
RoadIds add_road_ids(const std::string& network, const ImportedRoads& roads, const OpenDrive& map);

}  // namespace reprise::towns
