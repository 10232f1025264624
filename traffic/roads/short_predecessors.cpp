#include "traffic/roads/short_predecessors.h"

#include <algorithm>
#include <utility>

namespace reprise::traffic {

namespace {

constexpr double way_of_a_tick = 2;   // [m] at most, at 40 m/s
constexpr double least_length = 0.1;  // [m] of SUMO's lanes
constexpr double longest_tail = 20;   // [m] a bus and more
constexpr std::size_t most = 16;      // more only in broken nets

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// For every lane those that lead to it.
Neighbours lanes_before(const world::TownT& town) {
    Neighbours before(town.lanes.size());
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        for (const world::Link& link : town.lanes[i].links)
            before[link.via() == world::none ? link.to() : link.via()].push_back(i);
    return before;
}

/// Adds how far [m] before the start of `lane` there end lanes that a tail may pass in one tick.
/// `at` is where `lane` starts itself.
void add_short_ends(const world::TownT& town,
                    const Neighbours& before,
                    std::uint32_t lane,
                    double at,
                    std::vector<double>& ends) {
    for (const std::uint32_t one : before[lane]) {
        const double length = std::max(least_length, town.lanes[one].sumo_length);
        if (length < way_of_a_tick)
            ends.push_back(at);
        if (at + length < longest_tail && ends.size() < most)
            add_short_ends(town, before, one, at + length, ends);
    }
}

}  // namespace

std::map<std::string, ShortPredecessors> lanes_with_short_predecessors(const world::TownT& town,
                                                                       const RoadGraph& graph) {
    std::map<std::string, ShortPredecessors> lanes;
    const Neighbours before = lanes_before(town);
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != world::LaneKind::internal || graph.edge_of(i) == world::none)
            continue;
        ShortPredecessors found{i, {}};
        add_short_ends(town, before, i, 0, found.ends);
        if (!found.ends.empty())
            lanes.emplace(town.lanes[i].name, std::move(found));
    }
    return lanes;
}

}  // namespace reprise::traffic
