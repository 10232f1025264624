#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/car.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// [m] What is longer needs more than its lane in a bend.
constexpr double longest_short_car = 7;

/// What stands or moves on the ground, seen from above: an oriented box.
struct Footprint {
    Eigen::Vector2d centre;
    Eigen::Vector2d direction;  ///< unit, along its length
    double z = 0;               ///< [m] of the ground below it
    double half_length = 0;
    double half_width = 0;
    Eigen::Vector2d velocity;
    double clearance = 0;    ///< [m] that one who passes leaves beside it
    bool is_needed = false;  ///< road that one who passes something will need: nothing stands there
    bool drives = false;     ///< a vehicle with mass, or on a trajectory: SUMO has a copy of it
    bool boxed_in = false;   ///< a car of SUMO's that will not drive on
    bool is_afoot = false;   ///< somebody of the town's, who steps aside; no scenario's
    std::uint32_t id = 0;
};

/// All in the last tick that SUMO does not know, or only as a point in the middle of a lane:
/// walkers, props, open doors, vehicles with mass, and those of `cars` that SUMO does not drive,
/// that are aside of their lane or that are boxed in. Long ones in pieces, so that each is short
/// against the bends of a road. In the order of their kinds, and of their ids.
void gather_footprints(const world::TickView& last,
                       std::span<const Car> cars,
                       std::vector<Footprint>& footprints);

}  // namespace reprise::traffic
