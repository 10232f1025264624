#pragma once

#include <cstdint>

#include "traffic/cars/cars.h"
#include "traffic/orders.h"
#include "traffic/roads/road_graph.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// What SUMO's own cars do with their blue lamps on.
///
/// MUST    drive over junctions at red, or against the right of way, where nobody comes who would
///         not stop; else wait before them.
/// ASSUMES that others let it through (see rescue_lane.h), and Meetings and Lookout keep it from
///         driving into anybody.
/// GOES    SUMO is told to mind neither lights nor right of way; here the speed towards a junction
///         is held down, to that of one who looks, or to stop before it.
/// KEEPS   with each car, whether SUMO was told.
class BlueLamps {
  public:
    /// All of them must outlive this. `step` [s] of a tick.
    BlueLamps(const world::TownT& town,
              const world::LaneMap& lanes,
              const RoadGraph& graph,
              const Orders& orders,
              double step)
        : town_(&town),
          lanes_(&lanes),
          graph_(&graph),
          orders_(&orders),
          step_(step) {}

    /// Before SUMO's step, behind RescueLane and before Lookout.
    void advance(const world::TickView& last, Cars& cars, std::uint64_t tick) const;

  private:
    double before_junction(const Car& car, const Cars& cars, const world::TickView& last) const;
    bool has_right_of_way(const Car& car, const world::TickView& last) const;
    bool would_meet_anybody(const Car& car, const Cars& cars, const world::TickView& last) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    const RoadGraph* graph_;
    const Orders* orders_;
    double step_;  ///< [s]
};

}  // namespace reprise::traffic
