#pragma once

#include <string>
#include <vector>

#include "towns/maps/map_shapes.h"

namespace reprise::towns {

/// Bridges that a flat network must have, though it does not say so.
struct GuessedBridges {
    std::string network;         ///< the same one, whose lanes say of which way they are (origId)
    std::vector<MapShape> ways;  ///< each a few metres of a road around what it passes over
};

/// Where roads for cars cross without a junction, one of them passes over the other. Networks that
/// were made without heights have lost which one: a road of one lane goes over others, as ramps
/// mostly do; else the one that runs more to the north. Nothing in networks that have heights.
GuessedBridges guess_bridges(const std::string& network);

/// A network whose lanes do not say any more of which way they are.
std::string without_origins(const std::string& network);

}  // namespace reprise::towns
