#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "walkers/map/walk_map.h"
#include "world/town.h"

namespace reprise::test {

/// Two pieces of a town's pavement that the network joins, and that nobody gets over.
struct Seam {
    std::string from;  ///< lanes
    std::string to;
    Eigen::Vector3d stuck_at{0, 0, 0};  ///< world
    std::string why;
};

struct Seams {
    int pairs = 0;  ///< asked for
    int off = 0;    ///< of them, no place of the one or the other is on the map
    std::vector<Seam> all;
};

/// Asks for every two sidewalks, walking areas and crossings that the network joins whether one
/// gets from the middle of the one to that of the other: by a way that is not much longer than the
/// straight one, and step by step along it, as a walker goes.
Seams seams_of(const world::TownT& town, const walkers::WalkMap& map);

}  // namespace reprise::test
