#pragma once

#include <cstdint>

#include "traffic/cars/cars.h"
#include "world/town.h"

namespace reprise::traffic {

/// How often SUMO's own cars look around and decide: who rolls along its lane in every second tick,
/// who stands and waits in every fifth, in a rhythm of its own; everybody else in each. That is
/// less work than to decide in each tick, and still quicker than people react.
///
/// MUST    let decide in every tick: who is told something of ours, because in between SUMO 1.15
///         keeps a car's acceleration and obeys a tick late; and who comes to a halt or to the end
///         of its lane, because it would go on by the plan that it had, over a line or by its old
///         route, and SUMO ends the process over a car that is where its route does not lead.
/// KEEPS   with each car, what SUMO was told.
class Decisions {
  public:
    /// `town` must outlive this. `step` [s] of a tick.
    Decisions(const world::TownT& town, double step) : town_(&town), step_(step) {}

    /// Before SUMO's step, behind all who tell cars something. O(cars).
    void follow(Cars& cars) const;

  private:
    std::uint32_t may_skip(const Car& car) const;  ///< [ticks]

    const world::TownT* town_;
    double step_;  ///< [s]
};

}  // namespace reprise::traffic
