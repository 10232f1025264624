#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/obstructions.h"
#include "world/digest.h"
#include "world/town.h"

namespace reprise::traffic {

/// What blocks a lane beside others, as SUMO sees it: a short vehicle that stands some metres
/// before it. So SUMO's own lane changes lead around it, and from far enough away to pull out.
///
/// MUST    stand for what lies or stands still in the middle of a lane that has a neighbour.
/// ASSUMES that cars brake for the thing itself (see lookout.h): a stand-in is but a reason to
///         change lanes.
/// GOES    one for the first of several things close behind each other, once it has stood for a
///         second and nobody is on the place; gone with it.
/// KEEPS   where things stand, since when, and under which name SUMO has the stand-in.
class StandIns {
  public:
    /// Both must outlive this. `step` [s] of a tick.
    StandIns(const world::TownT& town, const RoadGraph& graph, double step)
        : town_(&town),
          graph_(&graph),
          step_(step) {}

    /// Before SUMO's step. `obstructions` as Obstructions::all().
    void advance(std::span<const Obstruction> obstructions, const Cars& cars, std::uint64_t tick);

    /// Nothing where there is none.
    void add_to(world::Hasher& hasher) const;

  private:
    struct StandIn {
        std::uint32_t lane = world::none;
        std::uint32_t id = 0;     ///< of what it stands for
        double begin = 0;         ///< [m] of that, along the lane
        std::uint64_t since = 0;  ///< tick
        std::string sumo;         ///< empty: not there yet
    };

    void find_wanted(std::span<const Obstruction> obstructions);
    void place(StandIn& one, const Cars& cars);

    const world::TownT* town_;
    const RoadGraph* graph_;
    double step_;
    std::vector<StandIn> all_;     ///< by lane, then along it
    std::vector<StandIn> wanted_;  ///< likewise, of this tick
    std::uint32_t added_ = 0;      ///< names are never used again
};

}  // namespace reprise::traffic
