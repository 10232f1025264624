#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "world/lanes/planner.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// [m] The shortest change of lanes, and so the shortest lane that can be left. A quintic step of w
/// metres aside in L metres is bent by 5.8 w / L^2 at most: 10 m ask a car for nearly all its
/// steering angle.
inline constexpr double shortest_change = 10;

/// Where a way leads in the end.
enum class Continuation : std::uint8_t {
    dead_end,
    turning,  ///< on, but not without turning around
    free
};

/// A way over driving lanes, each a link or a neighbour ahead of the one before.
struct Plan {
    std::vector<std::uint32_t> lanes;         ///< without the one where it begins
    double length = 0;                        ///< [m]
    std::uint32_t unreachable = world::none;  ///< the first stop that no way leads to
};

/// Where to go on for one who cannot go as planned.
struct Detour {
    std::uint32_t link = 0;  ///< index in lane.links
    Plan plan;               ///< from the start of the lane behind it
};

/// The lanes as a graph for drivers: ahead through the links, sideways to the neighbours.
/// Constant; built once from the town in O(lanes).
class LaneGraph {
  public:
    explicit LaneGraph(const world::TownT& town);

    const world::TownT& town() const { return *town_; }

    /// Links of a lane that a wandering driver may take: those with the best continuation; to turn
    /// around, into a circle, or by a corner that no car can turn at, only where nothing else is
    /// left. Indices in lane.links.
    std::vector<std::uint32_t> choices(std::uint32_t lane) const;

    /// A lane in the same direction that leads on better.
    struct Better {
        std::uint32_t neighbour = world::none;  ///< the first step towards it
        int changes = 0;                        ///< of lanes, to get there
    };

    /// The nearest lane in the same direction whose own links have a better continuation, or as
    /// good a one that does not circle; none when there is no such lane. Ties go to the right.
    std::optional<Better> better_lane(std::uint32_t lane) const;

    /// Need who drives on from this lane, and chooses well, never stop where a road ends?
    bool goes_on(std::uint32_t lane) const { return continuation_[lane] != Continuation::dead_end; }

    /// Does who stays on this lane go round and round a small ring, as on the inner lane of a
    /// roundabout?
    bool circles(std::uint32_t lane) const { return circles_[lane]; }

    /// The internal lanes of a link, in driving order.
    std::vector<std::uint32_t> inside(const world::Link& link) const;

    /// The lane behind the junction for one who is on this internal lane, or none.
    std::uint32_t exit(std::uint32_t internal_lane) const { return exit_[internal_lane]; }

    /// Does a stop sign stand at the end of this lane's road?
    bool has_stop_sign(std::uint32_t lane) const { return has_stop_sign_[lane]; }

    /// Do people cross a street at this junction?
    bool has_walkers_crossing(std::uint32_t junction) const {
        return junction < has_crossing_.size() && has_crossing_[junction];
    }

    /// Driving lanes that end at a junction, ascending.
    std::span<const std::uint32_t> incoming(std::uint32_t junction) const;

    /// world::Planner's way from a place through all of `stops` in their order, the last one at
    /// `last_s` of its lane, the others anywhere on theirs.
    Plan plan(world::LanePlace from,
              std::span<const std::uint32_t> stops,
              double last_s,
              world::LaneChanges changes = world::LaneChanges::allowed) const;

    /// Of the links of a lane the one behind which the shortest way through the stops begins, and
    /// that way; none: no link leads there. Ties go to the first.
    std::optional<Detour> detour(std::uint32_t lane,
                                 std::span<const std::uint32_t> stops,
                                 double last_s,
                                 world::LaneChanges changes = world::LaneChanges::allowed) const;

  private:
    Continuation continuation(const world::Link& link) const;
    Continuation straight_continuation(std::uint32_t lane) const;  ///< without changing lanes
    std::vector<std::uint32_t> reachable_sideways(std::uint32_t lane) const;  ///< nearest first
    void find_dead_ends();
    void find_circles();
    bool is_tight(std::uint32_t lane, const world::Link& link) const;
    std::uint32_t only_way_on(std::uint32_t lane) const;

    const world::TownT* town_;
    std::vector<Continuation> continuation_;
    std::vector<bool> circles_;  ///< [lane]
    std::vector<std::uint32_t> exit_;
    std::vector<std::vector<std::uint32_t>> incoming_;
    std::vector<bool> has_stop_sign_;
    std::vector<bool> has_crossing_;  ///< [junction]
};

}  // namespace reprise::drivers
