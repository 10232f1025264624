#pragma once

#include <cstdint>

#include "traffic/car.h"
#include "traffic/road_graph.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

/// Plans on from car.last_lane: at every junction it draws one of the ways that go on, until the
/// plan reaches `distance` metres further or a dead end. Changes route, last_lane, draws, dead_end.
void walk_on(
    Car& car, const RoadGraph& graph, world::ClassSet classes, std::uint64_t seed, double distance);

/// A new plan from this lane on.
void walk_from(std::uint32_t lane,
               Car& car,
               const RoadGraph& graph,
               world::ClassSet classes,
               std::uint64_t seed,
               double distance);

}  // namespace reprise::traffic
