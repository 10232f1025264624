#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/bodies.h"
#include "drivers/control/ego.h"
#include "drivers/road_map.h"
#include "drivers/way/way.h"

namespace reprise::drivers {

/// Somebody as seen along the path: where their outline begins and ends, along it and beside it.
struct Neighbour {
    Body body;
    double rear = 0;   ///< [m] along the path
    double front = 0;  ///< [m] along the path
    double right = 0;  ///< [m] left of the path, the right end
    double left = 0;   ///< [m] left of the path
    double along = 0;  ///< [m/s] of its speed

    bool stands() const { return body.speed < 0.3; }
};

/// How far the road reaches beside the path, from its middle to both sides. [m], positive.
struct RoadWidth {
    double lane_left = 0, lane_right = 0;  ///< of our lane
    double own_left = 0, own_right = 0;    ///< of all lanes of our direction
    double road_left = 0, road_right = 0;  ///< with the oncoming lanes across the centre line
};

RoadWidth road_width(const world::TownT& town, std::uint32_t lane);

/// Everybody within `behind` and `ahead` metres of the rear axle who is within 20 m of the path.
/// Before its start and beyond its end the path goes on straight.
void look_along(const world::TickView& last,
                const Ego& ego,
                const Path& path,
                double behind,
                double ahead,
                std::vector<Neighbour>& neighbours);

/// [m] by which somebody whose front is at `s` of `lane` is away from `goal_s` on `goal`, along the
/// lanes, over junctions; infinity when that is more than `most`, or never.
double distance_along_lanes(const LaneGraph& graph,
                            std::uint32_t lane,
                            double s,
                            std::uint32_t goal,
                            double goal_s,
                            double most);

}  // namespace reprise::drivers
