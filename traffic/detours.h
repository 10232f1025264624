#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "traffic/route_planner.h"
#include "world/town.h"

namespace reprise::traffic {

/// Drivers whose way is full take another one. Without that, queues that reach back from junction
/// to junction close a circle in a dense town, and nobody moves again: every driver waits for the
/// one ahead to leave a road that he himself keeps full.
class Detours {
  public:
    /// All of them must outlive this. `step` [s] of a tick.
    Detours(const world::TownT& town,
            const RoadGraph& graph,
            const RoutePlanner& routes,
            double step)
        : town_(&town),
          graph_(&graph),
          routes_(&routes),
          step_(step) {}

    /// Changes the routes of those background cars that come to the end of their lane and cannot
    /// go on, or that have waited there for long.
    void take(Cars& cars, std::uint64_t tick) const;

  private:
    std::vector<double> room_at_starts(const Cars& cars) const;
    bool looks_around(const Car& car, std::uint64_t tick) const;
    bool is_shut(const Car& car, const std::vector<double>& room) const;
    void turn_off(Car& car, const std::vector<double>& room) const;

    const world::TownT* town_;
    const RoadGraph* graph_;
    const RoutePlanner* routes_;
    double step_;
};

}  // namespace reprise::traffic
