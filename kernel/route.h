#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// Where a way leads in the end.
enum class Outlook : std::uint8_t {
    nowhere,  ///< into a dead end
    turning,  ///< on, but not without turning around
    free
};

/// The lanes as a graph for drivers: ahead through the links, sideways to the neighbours.
/// Constant; built once from the town in O(lanes).
class LaneGraph {
  public:
    explicit LaneGraph(const world::TownT& town);

    const world::TownT& town() const { return *town_; }

    /// Links of a lane that a wandering driver may take: those with the best outlook; to turn
    /// around only where nothing else is left. Indices in lane.links.
    std::vector<std::uint32_t> choices(std::uint32_t lane) const;

    /// The neighbour towards the nearest lane in the same direction whose own links have a better
    /// outlook; none when there is no such lane. Ties go to the right.
    std::uint32_t better_neighbour(std::uint32_t lane) const;

    /// The internal lanes of a link, in driving order.
    std::vector<std::uint32_t> inside(const world::Link& link) const;

    /// The lane behind the junction for one who is on this internal lane, or none.
    std::uint32_t exit(std::uint32_t internal_lane) const { return exit_[internal_lane]; }

    /// Driving lanes that end at a junction, ascending.
    std::span<const std::uint32_t> incoming(std::uint32_t junction) const;

    /// The driving lanes of world::Planner's way from the start of one lane to the end of another,
    /// both included; empty: none.
    std::vector<std::uint32_t> shortest(std::uint32_t source, std::uint32_t target) const;

    /// The way that passes all of `stops` in their order. Throws world::Error naming the lane that
    /// cannot be reached.
    std::vector<std::uint32_t> plan(std::uint32_t source,
                                    std::span<const std::uint32_t> stops) const;

  private:
    Outlook outlook(const world::Link& link) const;
    Outlook straight_outlook(std::uint32_t lane) const;  ///< without changing lanes
    std::vector<std::uint32_t> reachable_sideways(std::uint32_t lane) const;  ///< nearest first
    void find_dead_ends();

    const world::TownT* town_;
    std::vector<Outlook> outlook_;
    std::vector<std::uint32_t> exit_;
    std::vector<std::vector<std::uint32_t>> incoming_;
};

}  // namespace reprise::kernel
