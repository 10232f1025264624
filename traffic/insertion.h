#pragma once

#include <string>

#include "traffic/insertion_points.h"
#include "traffic/route_planner.h"
#include "world/town.h"

namespace reprise::traffic {

/// Puts cars into SUMO's simulation.
class Insertion {
  public:
    /// All three must outlive this.
    Insertion(const world::TownT& town, const RoadGraph& graph, const RoutePlanner& routes)
        : town_(&town),
          graph_(&graph),
          routes_(&routes) {}

    /// The car stands at that point from now on, with its speed, a route from there, and a type of
    /// the fleet (see fleet.h).
    void insert(Car& car, const InsertionPoint& point, const std::string& type) const;

  private:
    const world::TownT* town_;
    const RoadGraph* graph_;
    const RoutePlanner* routes_;
};

}  // namespace reprise::traffic
