#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "traffic/roads/road_graph.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// An internal lane that is led to by lanes so short that the tail of a vehicle on it may pass a
/// whole one of them in one tick; see Mirrors::enter_again.
struct ShortPredecessors {
    std::uint32_t lane = world::none;
    std::vector<double> ends;  ///< [m] where those lanes end, before the start of this one
};

/// All of them, by SUMO's name of the lane. None in most towns: netconvert makes such lanes of
/// roads that are hardly longer than the junctions at their ends.
std::map<std::string, ShortPredecessors> lanes_with_short_predecessors(const world::TownT& town,
                                                                       const RoadGraph& graph);

}  // namespace reprise::traffic
