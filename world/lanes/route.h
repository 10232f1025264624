#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "world/town.h"

namespace reprise::world {

/// A place on the centre line of a lane for cars.
struct LanePlace {
    std::uint32_t lane = 0;  ///< index in town.lanes
    double s = 0;            ///< [m] in [0, length]
};

/// What a driver is told who knows nothing of the map: what to do at the next junction. The five
/// commands of Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL 2017.
enum class RouteCommand : std::uint8_t { follow_lane, straight, left, right, reach_goal };

/// "follow_lane", ...
const char* name_of(RouteCommand command);

/// A way from one place to another.
struct Route {
    /// A stretch of one lane.
    struct Piece {
        std::uint32_t lane = 0;
        double from = 0;   ///< [m] on the lane
        double to = 0;     ///< [m] on the lane
        double start = 0;  ///< [m] along the route, of `from`
    };

    struct Step {
        RouteCommand command = RouteCommand::follow_lane;
        double begins = 0;  ///< [m] along the route; it holds until the next one begins
    };

    std::vector<Piece> pieces;  ///< in driving order, internal lanes included; where two follow
                                ///< each other on one edge, lanes are changed
    std::vector<Step> steps;    ///< the first begins at 0, the last is reach_goal at the end
    double length = 0;          ///< [m]
};

/// [m] on a lane that runs beside another one: at the same share of its length.
inline double beside(const LaneT& lane, double s, const LaneT& neighbour) {
    return s * neighbour.length / lane.length;
}

/// Driving lanes in their order, without repeats: what a driver is given as a route.
std::vector<std::uint32_t> driving_lanes(const TownT& town, const Route& route);

/// The command that holds there. `along`: [m] along the route.
RouteCommand command_at(const Route& route, double along);

/// [m] along the route to the goal, from a place on it or on a lane beside it; none elsewhere: plan
/// anew. O(pieces).
std::optional<double> distance_to_goal(const TownT& town, const Route& route, LanePlace place);

/// The middle of the way, world. Where lanes are changed the line goes over within 30 m at most.
/// No repeats; at least two points unless the route has no length.
std::vector<Eigen::Vector3d> centre_line(const TownT& town, const Route& route);

}  // namespace reprise::world
