#pragma once

#include <cstdint>
#include <vector>

#include "traffic/cars/car.h"
#include "traffic/roads/lane_lines.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/footprints.h"
#include "traffic/sight/obstructions.h"

namespace reprise::traffic {

/// What a body sweeps over beside its lane: a tail swings out and a middle cuts in where one turns.
///
/// MUST    stop a car before it would sweep over somebody there.
/// ASSUMES that of people who walk about nobody stays under a tail (walkers/threats.h): to wait for
///         those who wait themselves, in the middle of a junction, is to block it.
/// GOES    a long vehicle looks at all who stand or lie there, and not for ever: who stands there
///         for long may never go away, and then brushing past is the driver's business; but never
///         past vehicles with mass, which it would hit. Over people it creeps, and stops for
///         seconds at a time where its body would be deep in one. A short one looks at vehicles
///         with mass alone; it would stand before one that stands for ever if it wanted more than
///         it needs. Of a vehicle with mass that drives past a long one thinks where that will be.
/// KEEPS   with each car, until when it brushes past, and that it cannot: Demand takes it out then.
class Sweeping {
  public:
    /// All must outlive this. `step` [s] of a tick.
    Sweeping(const Obstructions& obstructions,
             const LaneLines& lines,
             const RoadGraph& graph,
             double step)
        : obstructions_(&obstructions),
          lines_(&lines),
          graph_(&graph),
          step_(step) {}

    /// Behind Obstructions::look, and before anything is asked.
    void look();

    /// [m/s] infinite where nobody is beside its way.
    double allowed_speed(Car& car, std::uint64_t tick) const;

  private:
    struct Beside;

    void gather(const Car& car, bool all, Beside& beside) const;

    const Obstructions* obstructions_;
    const LaneLines* lines_;
    const RoadGraph* graph_;
    double step_;                     ///< [s]
    std::vector<Footprint> driving_;  ///< vehicles with mass or on a trajectory
};

}  // namespace reprise::traffic
