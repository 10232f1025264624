#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "towns/import/signal_sites.h"

namespace reprise::towns {

/// A stop sign, or one to give way, at the end of a driving lane. It is for the whole road.
struct LaneSign {
    std::uint32_t lane = 0;
    bool stops = false;
};

/// The signs of an OpenDRIVE map, those at the ends of lanes only, in its order.
std::vector<LaneSign> lane_signs(const OpenDrive& map, const ImportedRoads& roads);

/// What netconvert must be told so that a map's stop and yield signs count: node and edge files
/// that change the junctions of a network. It gets the network itself as well, so that ids agree.
struct RightOfWay {
    std::string nodes;  ///< XML; empty: nothing to change
    std::string edges;
    int junctions = 0;                       ///< that change
    std::set<std::string> edges_with_stops;  ///< ids of the roads with a stop sign there
};

/// Roads with a sign get a lower priority. A junction becomes an all-way stop where every road has
/// a stop sign, and else a priority stop where one has. Where every road has a yield sign, who
/// comes from the right goes first. Lit junctions stay as they are.
RightOfWay right_of_way(const std::vector<LaneSign>& signs, const world::TownT& town);

/// The network with stops at these roads only: at a priority stop netconvert makes every link one
/// that gives way to anybody, those of the main road to walkers on a crossing. Links of all other
/// roads give way without a stop; all-way stops stay.
std::string stop_only_at(const std::set<std::string>& edges, const std::string& network);

/// Roads with a stop or yield sign at junctions without lights, and how many of them do give way in
/// the network.
struct ObeyedSigns {
    int roads = 0;
    int giving_way = 0;
};

ObeyedSigns obeyed_signs(const std::vector<LaneSign>& signs, const world::TownT& town);

}  // namespace reprise::towns
