#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Who waits at a junction for somebody who stands as well goes first in the end. By SUMO's rules
/// each waits for the one on his right, or for whom he sees in the junction, and for ever.
///
/// MUST    let one go on, of those who wait for each other.
/// ASSUMES that Lookout keeps him from driving into anybody.
/// GOES    once a second: of those who have stood at a junction for longer than anybody waits there
///         for a gap the longest, one in each place, is told not to mind those who stand near it;
///         the next one when that was of no use. Not at lights, before which one has to wait.
/// KEEPS   with each car, whether it was told.
class Standoffs {
  public:
    /// Both must outlive this. `step` [s] of a tick.
    Standoffs(const world::TownT& town, const RoadGraph& graph, double step)
        : town_(&town),
          graph_(&graph),
          step_(step) {}

    /// Before SUMO's step.
    void advance(const world::TickView& last, Cars& cars, std::uint64_t tick) const;

  private:
    bool waits(const Car& car) const;
    bool is_through(const Car& car) const;
    bool is_ahead(const Car& other, const Car& car) const;
    std::string standing_near(const Car& car, const world::TickView& last, const Cars& cars) const;

    const world::TownT* town_;
    const RoadGraph* graph_;
    double step_;  ///< [s]
};

}  // namespace reprise::traffic
