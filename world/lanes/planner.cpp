#include "world/lanes/planner.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <tuple>

#include "world/check.h"
#include "world/frames.h"
#include "world/lanes/make_route.h"

namespace reprise::world {

namespace {

constexpr std::uint32_t most_changes = 8;  // on one street

constexpr double turn_around_cost = 1000;  // [m] of detour

/// [m] of detour that a change of lanes is worth; `room`: [m] that it has for itself.
double change_cost(double room) {
    constexpr double calm = 40;
    constexpr double possible = 20;
    if (room < possible)
        return 10'000;
    return room < calm ? 200 : 40;
}

/// lane + lanes in the town * (2 * changes of lanes on this street + (1: it was not entered at its
/// start, but at the height of the way's start)).
using Node = std::uint32_t;

class Search {
  public:
    Search(const TownT& town, LanePlace from, LanePlace to, LaneChanges allowed)
        : town_(town),
          most_(allowed == LaneChanges::forbidden ? 0 : most_changes),
          count_(static_cast<Node>(town.lanes.size())),
          goal_(to),
          goal_point_(point_at(town.lanes[to.lane], to.s).position),
          entry_(town.lanes.size(), 0),
          cost_(layers * town.lanes.size(), std::numeric_limits<double>::infinity()),
          last_(layers * town.lanes.size(), none) {
        enter_beside(from);
        reach(count_ + from.lane, none, 0);
    }

    /// The last node before the goal; none: no way leads there.
    std::optional<Node> run() {
        double best = std::numeric_limits<double>::infinity();
        std::optional<Node> arrival;
        while (!open_.empty()) {
            const auto [estimate, node, cost] = open_.top();
            open_.pop();
            if (estimate >= best)
                break;
            if (cost > cost_[node])
                continue;
            if (lane_of(node) == goal_.lane && goal_.s >= entry(node)) {
                const double there = cost_[node] + goal_.s - entry(node) + haste(node);
                if (there < best) {
                    best = there;
                    arrival = node;
                }
            }
            expand(node);
        }
        total_ = best;
        return arrival;
    }

    double total() const { return total_; }

    std::vector<std::uint32_t> lanes_to(Node node) const {
        std::vector<std::uint32_t> lanes;
        for (; node != none; node = last_[node])
            lanes.push_back(lane_of(node));
        std::reverse(lanes.begin(), lanes.end());
        return lanes;
    }

  private:
    static constexpr Node layers = 2 * (most_changes + 1);

    std::uint32_t lane_of(Node node) const { return node % count_; }

    bool is_midway(Node node) const { return (node / count_) % 2 == 1; }

    std::uint32_t changes(Node node) const { return node / count_ / 2; }

    double entry(Node node) const { return is_midway(node) ? entry_[lane_of(node)] : 0; }

    Eigen::Vector3d place(Node node) const {
        return point_at(town_.lanes[lane_of(node)], entry(node)).position;
    }

    /// All lanes beside the start can be entered at its height.
    void enter_beside(LanePlace from) {
        const LaneT& start = town_.lanes[from.lane];
        entry_[from.lane] = from.s;
        for (const auto side : {&LaneT::left, &LaneT::right})
            for (std::uint32_t lane = start.*side; lane < count_; lane = town_.lanes[lane].*side)
                entry_[lane] = beside(start, from.s, town_.lanes[lane]);
    }

    /// What changes of lanes cost more because they must be done before the goal.
    double haste(Node node) const {
        const std::uint32_t count = changes(node);
        if (count == 0)
            return 0;
        const double left = town_.lanes[goal_.lane].length - entry(node);
        const double to_goal = goal_.s - entry(node);
        return count * (change_cost(to_goal / count) - change_cost(left / count));
    }

    void reach(Node node, Node from, double cost) {
        if (!(cost < cost_[node] || (cost == cost_[node] && from < last_[node])))
            return;
        const bool new_cost = cost < cost_[node];
        cost_[node] = cost;
        last_[node] = from;
        if (new_cost)
            open_.emplace(cost + (place(node) - goal_point_).norm(), node, cost);
    }

    void expand(Node node) {
        const LaneT& lane = town_.lanes[lane_of(node)];
        const double left = lane.length - entry(node);
        const Eigen::Vector3d here = place(node);
        for (const Link& link : lane.links) {
            const std::uint32_t next = link.via() < count_ ? link.via() : link.to();
            // No less than the straight line, where a network has gaps between its lanes.
            if (next >= count_ || !is_for_cars(town_.lanes[next]))
                continue;
            const double extra = link.turn() == Turn::around ? turn_around_cost : 0;
            reach(next, node, cost_[node] + std::max(left, (place(next) - here).norm()) + extra);
        }
        if (changes(node) == most_)
            return;
        const double change = change_cost(left / (changes(node) + 1));
        for (const std::uint32_t side : {lane.right, lane.left})
            if (side < count_ && town_.lanes[side].kind == LaneKind::driving) {
                const Node next = node - lane_of(node) + 2 * count_ + side;
                reach(next, node, cost_[node] + std::max(change, (place(next) - here).norm()));
            }
    }

    const TownT& town_;
    std::uint32_t most_;  ///< changes of lanes on one street
    Node count_;
    LanePlace goal_;
    Eigen::Vector3d goal_point_;
    std::vector<double> entry_;  ///< [lane] where one is that was entered midway
    std::vector<double> cost_;   ///< [node]
    std::vector<Node> last_;     ///< [node]
    using Entry = std::tuple<double, Node, double>;  // estimated cost of the whole way, cost so far
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
    double total_ = 0;
};

LanePlace clamped(const TownT& town, LanePlace place) {
    REPRISE_CHECK(place.lane < town.lanes.size() && is_for_cars(town.lanes[place.lane]),
                  "lane " + std::to_string(place.lane));
    return {place.lane, std::clamp(place.s, 0.0, town.lanes[place.lane].length)};
}

}  // namespace

std::optional<Route> Planner::plan(LanePlace from, LanePlace to) const {
    from = clamped(*town_, from);
    to = clamped(*town_, to);
    Search search(*town_, from, to, changes_);
    const std::optional<Node> arrival = search.run();
    if (!arrival)
        return std::nullopt;
    return make_route(*town_, search.lanes_to(*arrival), from.s, to.s);
}

std::optional<double> Planner::cost(LanePlace from, LanePlace to) const {
    Search search(*town_, clamped(*town_, from), clamped(*town_, to), changes_);
    if (!search.run())
        return std::nullopt;
    return search.total();
}

}  // namespace reprise::world
