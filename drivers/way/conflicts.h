#pragma once

#include <cstdint>
#include <vector>

#include "drivers/way/lane_graph.h"
#include "world/tick.h"
#include "world/units.h"

namespace reprise::drivers {

/// A place on a lane whose traffic crosses or joins our way through a junction.
struct ConflictPoint {
    std::uint32_t lane = 0;
    double to_conflict = 0;                    ///< [m] from the lane's start to where the ways meet
    double our_s = 0;                          ///< the same place along our path
    std::uint32_t signal = world::none;        ///< of that lane's link
    world::Turn turn = world::Turn::straight;  ///< of that lane's link
    double pace = world::infinity;  ///< [m/s] at most through the junction, who turns there
    bool inside = false;            ///< an internal lane: who is there is in the junction already
    bool yields = false;            ///< that lane's link must give way, too
    bool from_right = false;
    bool oncoming = false;
};

/// All whose way meets ours when we take `link` out of `lane`; our path enters the junction at
/// `gate_s`. Found by geometry: centre lines that cross, or that end in the same lane.
std::vector<ConflictPoint> find_conflicts(const LaneGraph& graph,
                                          std::uint32_t lane,
                                          const world::Link& link,
                                          double gate_s);

/// Does anybody else cross the way of `link`, in a car or on foot? Where two roads merely join, or
/// become one, whoever waits stands in nobody's way but that of those who would wait behind him.
bool is_crossed(const LaneGraph& graph, std::uint32_t lane, const world::Link& link);

}  // namespace reprise::drivers
