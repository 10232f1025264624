#pragma once

#include <cstdint>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"

namespace reprise::traffic {

/// Routes for cars that drive on for ever: at every junction one of the ways that go on is drawn.
/// Changes a car's route, last_lane, draws and dead_end.
class RoutePlanner {
  public:
    static constexpr double length = 1500;  ///< [m] of route made at once

    /// `graph` must outlive this.
    RoutePlanner(const RoadGraph& graph, std::uint64_t seed) : graph_(&graph), seed_(seed) {}

    /// A new route from this lane on.
    void start(std::uint32_t lane, Car& car) const;

    /// Goes on from car.last_lane, by `length` or as far as a dead end.
    void extend(Car& car) const;

    /// From the end of the road that the car is on one of `ways` (lanes), and on from there.
    void turn_off(const std::vector<std::uint32_t>& ways, Car& car) const;

    /// Tells SUMO the car's route.
    void send(const Car& car) const;

    /// Extends every route that is about to end, and sends it.
    void keep_ahead(Cars& cars) const;

  private:
    std::uint32_t draw(const std::vector<std::uint32_t>& ways, Car& car) const;

    const RoadGraph* graph_;
    std::uint64_t seed_;
};

}  // namespace reprise::traffic
