#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "remote/wire_generated.h"
#include "world/lanes/route.h"
#include "world/tick_generated.h"
#include "world/town.h"

namespace reprise::remote {

/// What a driver is told about its way.
struct Guidance {
    Turning turning = Turning::none;  ///< none: no goal was given
    double way_to_goal = 0;           ///< [m] along the shortest way
};

/// Knows where a vehicle is to go, and says what to do next, from what is recorded alone: the
/// scenario's set_route and route_to, and the vehicle's place in each tick. Off the way, another
/// one is planned.
class Guide {
  public:
    /// `town` must outlive the guide.
    Guide(const world::TownT& town, std::uint32_t actor) : town_(&town), actor_(actor) {}

    /// Ticks in order, from the one in which the vehicle appears. O(pieces of the way); where it
    /// is planned, world::Planner's.
    Guidance look(const world::Tick& tick);

    /// The way that is left, as if the scenario said it now: its set_route with the stops that were
    /// not passed yet. Nothing where it said none.
    std::optional<world::CommandT> route_left() const;

  private:
    void hear(const world::Tick& tick);
    void pass_stops(std::uint32_t lane);
    std::optional<world::Route> plan(world::LanePlace from) const;

    const world::TownT* town_;
    std::uint32_t actor_;
    std::vector<std::uint32_t> stops_;  ///< lanes; the last holds the goal
    double goal_s_ = 0;                 ///< [m] on it
    std::size_t passed_ = 0;            ///< of the stops
    std::optional<world::Route> route_;
    std::uint32_t planned_on_ =
        world::none;  ///< the lane on which it was planned, or tried in vain
    Guidance last_;
};

}  // namespace reprise::remote
