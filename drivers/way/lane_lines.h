#pragma once

#include <vector>

#include <Eigen/Core>

#include "world/town.h"

namespace reprise::drivers {

/// The centre line between two places on a lane, [m] from its start; at least two points, world.
std::vector<Eigen::Vector3d> part_of(const world::LaneT& lane, double from, double to);

/// A change of lanes: from the centre line of one lane at `begin` to that of the neighbour within
/// `length` [m], as a quintic step: no jump in heading or curvature. A point a metre, at least
/// three, world.
std::vector<Eigen::Vector3d> change_line(const world::LaneT& here,
                                         const world::LaneT& there,
                                         double begin,
                                         double length);

}  // namespace reprise::drivers
