#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "world/town.h"

namespace reprise::world {

/// A street that meets a junction, seen from there. Lanes for cars, the rightmost in driving
/// direction first; a one-way street has them in one direction only.
struct JunctionArm {
    double yaw = 0;                       ///< [rad] from the junction out along the street
    std::vector<std::uint32_t> incoming;  ///< end at the junction
    std::vector<std::uint32_t> outgoing;  ///< begin behind it
    bool yields = false;  ///< who goes straight on from here must give way; no light says when
    bool stop_sign = false;
};

/// The streets of each junction, counter-clockwise from east: [junction][arm]. O(lanes log lanes).
std::vector<std::vector<JunctionArm>> arms_of_junctions(const TownT& town);

/// [lane] Does a stop sign stand at the end of its road? O(roads * signs).
std::vector<bool> lanes_with_stop_sign(const TownT& town);

/// A pedestrian crossing.
struct CrossingPlace {
    std::uint32_t lane = 0;  ///< index in town.lanes
    Eigen::Vector3d from;    ///< world; where its centre line begins and ends: the kerbs
    Eigen::Vector3d to;
    std::vector<std::uint32_t> incoming;  ///< lanes for cars that lead onto it, ascending
    std::vector<std::uint32_t> outgoing;  ///< lanes for cars that come off it
    bool lit = false;                     ///< has lights for walkers
};

/// All crossings of a town, ascending by lane. O(crossings * lanes near them).
std::vector<CrossingPlace> crossings_of(const TownT& town, const LaneMap& lanes);

}  // namespace reprise::world
