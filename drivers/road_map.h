#pragma once

#include <span>

#include "drivers/control/lateral_clearance.h"
#include "drivers/way/lane_graph.h"
#include "world/obstacle.h"
#include "world/town.h"

namespace reprise::drivers {

/// What the drivers of a town look things up in: constant, built once for all of them.
struct RoadMap {
    /// `town_of_run` and `lane_map` must outlive this; `obstacles` are looked at here only.
    RoadMap(const world::TownT& town_of_run,
            const world::LaneMap& lane_map,
            std::span<const world::Obstacle> obstacles)
        : town(town_of_run),
          lanes(lane_map),
          graph(town),
          clearances(town, lanes, obstacles) {}

    const world::TownT& town;
    const world::LaneMap& lanes;
    LaneGraph graph;
    LateralClearances clearances;
};

}  // namespace reprise::drivers
