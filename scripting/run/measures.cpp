#include "scripting/run/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace reprise::scripting {

namespace {

using world::LaneT;
using world::none;
using world::TownT;

constexpr double search_range = 200;  // [m]

/// [m] from a position on `from` to one on `to`, driving on, lane changes included. None when
/// further than the search range. Dijkstra over lanes; equal distances go by lane index.
std::optional<double> way(const TownT& town,
                          std::uint32_t from,
                          double s_from,
                          std::uint32_t to,
                          double s_to,
                          std::uint32_t& searched,
                          bool changes_lanes = true) {
    const std::string& target = town.lanes[to].edge;
    std::set<std::pair<double, std::uint32_t>> open{
        {-s_from, from}};  // distance to the lane's start
    std::set<std::uint32_t> closed;
    while (!open.empty()) {
        const auto [start, index] = *open.begin();
        open.erase(open.begin());
        ++searched;
        if (start > search_range || !closed.insert(index).second)
            continue;
        const LaneT& lane = town.lanes[index];
        const bool internal = lane.kind == world::LaneKind::internal;
        const bool is_there =
            changes_lanes ? lane.edge == target && (!internal || index == to) : index == to;
        if (is_there && start + s_to >= 0)
            return start + s_to;
        for (const std::uint32_t beside : {lane.left, lane.right})
            if (changes_lanes && beside != none && world::is_for_cars(town.lanes[beside]))
                open.emplace(start, beside);
        for (const world::Link& link : lane.links) {
            const std::uint32_t next = link.via() != none ? link.via() : link.to();
            if (next != none)
                open.emplace(start + lane.length, next);
        }
    }
    return std::nullopt;
}

/// From a's position to b's along the road; negative when b is behind.
std::optional<double> along_road(const TownT& town,
                                 const Body& a,
                                 const Body& b,
                                 std::uint32_t& searched) {
    if (a.lane == none || b.lane == none || a.ahead().dot(b.ahead()) < 0)
        return std::nullopt;
    const LaneT& lane_a = town.lanes[a.lane];
    const LaneT& lane_b = town.lanes[b.lane];
    const double s_a = place_on_lane(town, a).s;
    const bool together =
        a.lane == b.lane || (lane_a.edge == lane_b.edge && lane_a.kind == world::LaneKind::driving);
    if (together)
        return world::project(lane_a, b.position).s - s_a;
    const double s_b = place_on_lane(town, b).s;
    if (const auto ahead = way(town, a.lane, s_a, b.lane, s_b, searched))
        return *ahead;
    if (const auto behind = way(town, b.lane, s_b, a.lane, s_a, searched))
        return -*behind;
    return std::nullopt;
}

/// How far b's box reaches before and behind a's position, along a's heading.
std::pair<double, double> extent_along(const Body& a, const Body& b) {
    const Eigen::Vector3d axis = a.ahead();
    const double position = (b.position - a.position).dot(axis);
    const double cosine = b.ahead().dot(axis);
    const double across = b.half_width * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double front = position + b.front * cosine;
    const double rear = position - b.rear * cosine;
    return {std::min(front, rear) - across, std::max(front, rear) + across};
}

/// [m] by which a body reaches over the edge of a lane beside it.
double reach_into(const LaneT& lane, const Body& body) {
    const world::LaneProjection at = world::project(lane, body.centre());
    const double angle = body.yaw - world::point_at(lane, at.s).yaw;
    const double half_shadow = (body.front + body.rear) / 2 * std::abs(std::sin(angle)) +
                               body.half_width * std::abs(std::cos(angle));
    return lane.width / 2 + half_shadow - std::abs(at.t);
}

}  // namespace

world::LaneProjection place_on_lane(const TownT& town, const Body& body) {
    if (body.lane_s && body.lane_t)
        return {*body.lane_s, *body.lane_t, std::abs(*body.lane_t)};
    return world::project(town.lanes[body.lane], body.position);
}

Gap gap(const TownT& town, const Body& a, const Body& b) {
    auto [low, high] = extent_along(a, b);
    std::uint32_t searched = 0;
    if (const auto road = along_road(town, a, b, searched)) {
        low = *road - b.rear;
        high = *road + b.front;
    }
    const bool ahead = (low + high) / 2 >= (a.front - a.rear) / 2;
    const double length = ahead ? low - a.front : -a.rear - high;
    return {std::max(0.0, length), ahead, searched};
}

double lateral_gap(const Body& a, const Body& b) {
    const Eigen::Vector3d left(-std::sin(a.yaw), std::cos(a.yaw), 0);
    const double angle = b.yaw - a.yaw;
    const double half_length = (b.front + b.rear) / 2;
    const double half_shadow =
        half_length * std::abs(std::sin(angle)) + b.half_width * std::abs(std::cos(angle));
    return std::abs((b.centre() - a.position).dot(left)) - a.half_width - half_shadow;
}

bool share_lane(const TownT& town, const Body& a, const Body& b) {
    if (a.lane == none || b.lane == none)
        return false;
    if (a.lane == b.lane)
        return true;
    const LaneT& lane_a = town.lanes[a.lane];
    const LaneT& lane_b = town.lanes[b.lane];
    if (lane_a.edge == lane_b.edge)
        return reach_into(lane_a, b) >= intrusion || reach_into(lane_b, a) >= intrusion;
    const double s_a = place_on_lane(town, a).s;
    const double s_b = place_on_lane(town, b).s;
    std::uint32_t searched = 0;
    return way(town, a.lane, s_a, b.lane, s_b, searched, false) ||
           way(town, b.lane, s_b, a.lane, s_a, searched, false);
}

double distance(const Body& a, const Body& b) {
    return (a.centre() - b.centre()).norm();
}

double time_to_collision(const TownT& town, const Body& a, const Body& b) {
    return time_to_collision(gap(town, a, b), a, b);
}

double time_to_collision(const Gap& between, const Body& a, const Body& b) {
    const double speed_b = b.speed * a.ahead().dot(b.ahead());
    const double closing = between.ahead ? a.speed - speed_b : speed_b - a.speed;
    if (closing <= 0)
        return std::numeric_limits<double>::infinity();
    return between.length / closing;
}

}  // namespace reprise::scripting
