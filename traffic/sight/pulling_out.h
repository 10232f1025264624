#pragma once

#include <cstdint>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/obstructions.h"
#include "world/town.h"

namespace reprise::traffic {

/// Into the lane beside, from a standstill behind what blocks a lane. SUMO's own change of lanes
/// needs way to drive, which who came to stand close behind the thing has not.
///
/// MUST    begin only where the lane beside is free, and nobody on it has to brake hard.
/// ASSUMES that a car goes aside as it drives (see CarReader), SUMO having it in the new lane all
///         the while, and that others see a car that is aside (see footprints.h).
/// GOES    who has stood for some seconds, first behind a thing that lasts, is put into the lane
///         beside in SUMO and shown where it was, and from there drives to the middle of that lane;
///         not at all where a corner would touch something: then it is boxed in, and a thing like
///         that before it to those behind.
/// KEEPS   nothing beside the cars.
class PullingOut {
  public:
    /// All of them must outlive this. `step` [s] of a tick.
    PullingOut(const world::TownT& town,
               const RoadGraph& graph,
               const Obstructions& obstructions,
               double step)
        : town_(&town),
          graph_(&graph),
          obstructions_(&obstructions),
          step_(step) {}

    /// A car that stands begins to pull out, where it may. Moves it in SUMO.
    void begin(Car& car, const Cars& cars, std::uint64_t tick) const;

    /// Ends it, once the car is in its new lane.
    static void follow(Car& car);

    /// [m/s] sideways for one who is `off` [m] its lane's middle to end a change within a `step`
    /// [s] of SUMO, and not sooner than in a millisecond: of who would need less of the step SUMO
    /// asserts that nobody does.
    static double pace_to_end_change(double off, bool is_on_its_way_out, double step);

  private:
    void end_change(Car& car) const;
    bool stands_behind_a_thing(const Car& car, const Cars& cars) const;
    bool swing_into(std::uint32_t lane,
                    const world::LaneProjection& there,
                    Car& car,
                    std::uint64_t tick) const;
    bool may_use(const Car& car, double front, std::uint32_t beside) const;
    bool is_free(const Car& car, std::uint32_t beside, double front, const Cars& cars) const;
    double way_to(const Car& other, std::uint32_t beside, double front) const;

    const world::TownT* town_;
    const RoadGraph* graph_;
    const Obstructions* obstructions_;
    double step_;
};

}  // namespace reprise::traffic
