#include "traffic/roads/road_graph.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "world/geometry2d.h"
#include "world/models/vehicle_classes.h"
#include "world/tick.h"

namespace reprise::traffic {

using world::LaneKind;
using world::none;

RoadGraph::RoadGraph(const world::TownT& town, std::vector<world::ClassSet> classes)
    : town_(&town),
      classes_(std::move(classes)),
      edge_of_lane_(town.lanes.size(), none),
      edge_after_(town.lanes.size(), none) {
    // Edges, sorted by name; their lanes by index.
    std::map<std::string, std::map<int, std::uint32_t>> by_name;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        index_of_lane_.push_back(town.lanes[i].index);
        if (town.lanes[i].kind == LaneKind::driving)
            by_name[town.lanes[i].edge][town.lanes[i].index] = i;
    }
    for (const auto& [name, lanes] : by_name) {
        Edge edge;
        edge.name = name;
        for (const auto& [index, lane] : lanes) {
            index_of_lane_[lane] = static_cast<std::uint32_t>(edge.lanes.size());
            edge.lanes.push_back(lane);
            edge.length = town.lanes[lane].length;
            edge_of_lane_[lane] = edge_after_[lane] = static_cast<std::uint32_t>(edges_.size());
        }
        edges_.push_back(std::move(edge));
    }
    // What follows what, and where the lanes inside of junctions come from and lead to.
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        for (const std::uint32_t lane : edges_[i].lanes)
            for (const world::Link& link : town.lanes[lane].links) {
                const std::uint32_t next = edge_of_lane_[link.to()];
                if (next == none)
                    continue;
                edges_[i].successors.push_back(next);
                std::uint32_t via = link.via();
                for (int hops = 0; via != none && hops < 8; ++hops) {
                    edge_of_lane_[via] = i;
                    edge_after_[via] = next;
                    const auto& links = town.lanes[via].links;
                    via = links.empty() ? none : links.front().via();
                }
            }
        auto& successors = edges_[i].successors;
        std::sort(successors.begin(), successors.end());
        successors.erase(std::unique(successors.begin(), successors.end()), successors.end());
    }
}

bool RoadGraph::leads_to(std::uint32_t lane, std::uint32_t edge) const {
    const auto& links = town_->lanes[lane].links;
    return std::any_of(links.begin(), links.end(), [&](const world::Link& link) {
        return link.to() != none && edge_of_lane_[link.to()] == edge;
    });
}

bool RoadGraph::forks(std::uint32_t lane) const {
    const auto& links = town_->lanes[lane].links;
    for (auto one = links.begin(); one != links.end(); ++one)
        if (one->to() != none && std::any_of(one + 1, links.end(), [&](const world::Link& other) {
                return other.to() != none && edge_of_lane_[one->to()] == edge_of_lane_[other.to()];
            }))
            return true;
    return false;
}

/// To turn around from one lane into the other? A bus would sweep over all that is beside the road.
bool RoadGraph::is_too_narrow(std::uint32_t from, std::uint32_t to, double length) const {
    constexpr double longest = 7;  // [m] that turn anywhere
    constexpr double wide = 10;    // [m] between the two lanes
    const Eigen::Vector2d end = world::in_plan(town_->lanes[from].centre.back());
    const Eigen::Vector2d start = world::in_plan(town_->lanes[to].centre.front());
    return length > longest && (start - end).norm() < wide;
}

std::vector<std::uint32_t> RoadGraph::ways_on(std::uint32_t lane,
                                              world::ClassSet car,
                                              bool keeps_lane,
                                              double length) const {
    auto ways = [&](std::uint32_t from, bool around) {
        std::vector<std::uint32_t> found;
        for (const world::Link& link : town_->lanes[from].links)
            if ((link.turn() == world::Turn::around) == around && may_use(link.to(), car) &&
                town_->lanes[link.to()].kind == LaneKind::driving &&
                !(around && is_too_narrow(from, link.to(), length)))
                found.push_back(link.to());
        return found;
    };
    for (const bool around : {false, true}) {
        std::vector<std::uint32_t> found = ways(lane, around);
        if (!found.empty())
            return found;
        if (keeps_lane)
            continue;
        // From another lane of the road: SUMO changes lanes in time.
        for (const std::uint32_t other : edges_[edge_of_lane_[lane]].lanes) {
            if (!may_use(other, car))
                continue;
            const std::vector<std::uint32_t> more = ways(other, around);
            found.insert(found.end(), more.begin(), more.end());
        }
        std::sort(found.begin(), found.end());
        if (!found.empty())
            return found;
    }
    return {};
}

std::vector<std::uint32_t> RoadGraph::shortest(std::uint32_t from, std::uint32_t to) const {
    // Dijkstra; ties go to the lower edge index, so that the way is one and the same everywhere.
    constexpr double far = std::numeric_limits<double>::max();
    std::vector<double> cost(edges_.size(), far);
    std::vector<std::uint32_t> before(edges_.size(), none);
    using Item = std::tuple<double, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
    cost[from] = 0;
    open.emplace(0.0, from);
    while (!open.empty()) {
        const auto [here_cost, here] = open.top();
        open.pop();
        if (here_cost > cost[here])
            continue;
        if (here == to)
            break;
        for (const std::uint32_t next : edges_[here].successors) {
            const double next_cost = here_cost + edges_[next].length;
            if (next_cost < cost[next]) {
                cost[next] = next_cost;
                before[next] = here;
                open.emplace(next_cost, next);
            }
        }
    }
    if (cost[to] == far)
        return {};
    std::vector<std::uint32_t> way{to};
    while (way.back() != from)
        way.push_back(before[way.back()]);
    std::reverse(way.begin(), way.end());
    return way;
}

std::vector<std::string> RoadGraph::names(const std::vector<std::uint32_t>& edges) const {
    std::vector<std::string> found;
    found.reserve(edges.size());
    for (const std::uint32_t index : edges)
        found.push_back(edges_[index].name);
    return found;
}

}  // namespace reprise::traffic
