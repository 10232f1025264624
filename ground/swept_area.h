#pragma once

#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// A vehicle's body somewhere on its way. Metres and radians.
struct SweptBody {
    Eigen::Vector2d centre;
    double yaw = 0;
    double length = 0;
    double width = 0;
    double z = 0;  ///< of the road below its bumper

    /// Counter-clockwise, from its rear on the right; so much smaller on each side.
    world::Loop corners(double smaller = 0) const;
};

/// The body of a bus in bends and on its ways across junctions, every 0.75 m of its way: there it
/// does not lie along its lane, is wider than it, and its tail swings out over the kerb. Its bumper
/// drives along the lanes, its rear axle where the bumper has been, as traffic moves it
/// (traffic/cars/trail.h). O(metres of lanes).
std::vector<SweptBody> bus_bodies(const world::TownT& town);

}  // namespace reprise::ground
