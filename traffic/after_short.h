#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "traffic/road_graph.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// An internal lane with lanes close behind that the tail of a vehicle on it may pass in one tick.
struct AfterShort {
    std::uint32_t lane = world::none;
    std::vector<double> ends;  ///< [m] where those lanes end, before the start of this one
};

/// All of them, by SUMO's name of the lane. None in most towns: netconvert makes such lanes of
/// roads that are hardly longer than the junctions at their ends.
std::map<std::string, AfterShort> lanes_after_short_ones(const world::TownT& town,
                                                         const RoadGraph& graph);

}  // namespace reprise::traffic
