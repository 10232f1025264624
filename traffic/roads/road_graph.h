#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "world/models/vehicle_classes.h"
#include "world/town_generated.h"

namespace reprise::traffic {

/// Where one can drive from where: SUMO's edges (roads) and their lanes, with who may use them.
class RoadGraph {
  public:
    /// `classes` has one set a lane of the town, see ClassSet.
    RoadGraph(const world::TownT& town, std::vector<world::ClassSet> classes);

    struct Edge {
        std::string name;
        std::vector<std::uint32_t> lanes;       ///< driving lanes only, by index
        std::vector<std::uint32_t> successors;  ///< edges, ascending
        double length = 0;
    };

    const Edge& edge(std::uint32_t index) const { return edges_[index]; }

    std::size_t size() const { return edges_.size(); }

    /// The edge of a driving lane, or the one that an internal lane comes from; none for others.
    std::uint32_t edge_of(std::uint32_t lane) const { return edge_of_lane_[lane]; }

    /// The edge that an internal lane leads to; for others the same as edge_of.
    std::uint32_t edge_after(std::uint32_t lane) const { return edge_after_[lane]; }

    /// Of a driving lane, among those of its road; of others as the network counts them. SUMO's
    /// index, too: it has no other lanes beside them, see network_for_cars.
    std::uint32_t index_of(std::uint32_t lane) const { return index_of_lane_[lane]; }

    bool may_use(std::uint32_t lane, world::ClassSet car) const {
        return (classes_[lane] & car) != 0;
    }

    /// The lanes that a car of this class can go to from the end of `lane`, without a lane change
    /// where possible, or without one at all; turning around is the last resort, and none for a
    /// lorry or a bus, by its `length` [m], where the street is narrow. Ascending; empty at a dead
    /// end.
    std::vector<std::uint32_t> ways_on(std::uint32_t lane,
                                       world::ClassSet car,
                                       bool keeps_lane,
                                       double length) const;

    /// Does a link of this driving lane lead to that edge?
    bool leads_to(std::uint32_t lane, std::uint32_t edge) const;

    /// Does this driving lane lead to one edge by several ways? A car's route does not tell by
    /// which it goes.
    bool forks(std::uint32_t lane) const;

    /// Edges of the shortest way from one edge to another, both included; empty when there is none.
    std::vector<std::uint32_t> shortest(std::uint32_t from, std::uint32_t to) const;

    std::vector<std::string> names(const std::vector<std::uint32_t>& edges) const;

  private:
    bool is_too_narrow(std::uint32_t from, std::uint32_t to, double length) const;
    const world::TownT* town_;
    std::vector<world::ClassSet> classes_;
    std::vector<Edge> edges_;  ///< sorted by name
    std::vector<std::uint32_t> edge_of_lane_;
    std::vector<std::uint32_t> edge_after_;
    std::vector<std::uint32_t> index_of_lane_;
};

}  // namespace reprise::traffic
