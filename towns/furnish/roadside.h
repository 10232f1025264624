#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "world/lane_starts.h"
#include "world/town.h"

namespace reprise::towns {

/// One side of a road: its outer border, behind which the land begins, and what lies on the way
/// there from the outermost lane that cars use.
struct Roadside {
    std::uint32_t lane = world::none;    ///< the outermost one: a sidewalk where there is one
    std::uint32_t driven = world::none;  ///< the road's driving lane nearest to this side
    bool kerb_side = true;               ///< false: the inner side of a one-way road
    double side = -1;     ///< +1: the land is on the left of the driving direction, -1: right
    double walk = 0;      ///< [m] width of the sidewalk; 0: none
    world::LaneT border;  ///< only its centre line and length are filled
    world::LaneStarts starts = world::LaneStarts(border);
};

/// A pose beside a road. Metres and radians.
struct RoadsidePose {
    Eigen::Vector2d position;
    double z = 0;         ///< of the road
    double yaw = 0;       ///< driving direction
    Eigen::Vector2d out;  ///< away from the road
};

/// All sides of all roads, in the order of their lanes.
std::vector<Roadside> roadsides(const world::TownT& town);

/// `s` metres along the border, `away` metres out of it (negative: over the sidewalk and the road).
RoadsidePose roadside_pose(const Roadside& roadside, double s, double away);

/// The yaw of a building whose front looks at the road: x along the street, front at -y.
double facing_yaw(const Roadside& roadside, const RoadsidePose& at);

}  // namespace reprise::towns
