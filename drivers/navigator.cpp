#include "drivers/navigator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double braking_reserve = 50;  // [m] of path beyond the braking distance
constexpr double shortest_way = 150;    // [m]
constexpr double lost_distance = 4;     // [m] from the path: pushed away, or put elsewhere
constexpr double way_behind = 10;       // [m] kept behind the car

}  // namespace

Navigator::Navigator(const RoadMap& map,
                     std::uint64_t seed,
                     std::uint32_t actor,
                     double step,
                     double comfortable_braking)
    : map_(&map),
      way_(map.graph, seed, actor),
      step_(step),
      comfortable_braking_(comfortable_braking) {}

void Navigator::set_route(std::vector<std::uint32_t> stops, double last_s) {
    new_route_ = {std::move(stops), last_s};
}

void Navigator::change_lane(std::uint32_t lane) {
    new_lane_ = lane;
    new_lane_at_once_ = false;
}

void Navigator::switch_lane(std::uint32_t lane) {
    new_lane_ = lane;
    new_lane_at_once_ = true;
}

void Navigator::keep_lane(bool keep) {
    new_keeping_ = keep;
}

Navigator::Found Navigator::follow(Ego& ego, double beside) {
    Found found = Found::same;
    if (new_keeping_)
        way_.keep_lane(*new_keeping_);
    if (on_way_) {
        const double reach = 2 + 2 * std::abs(ego.speed) * step_;
        rear_axle_s_ = way_.path().project(ego.position, rear_axle_s_, reach);
        ego.rear_axle_s = rear_axle_s_;
    }
    if (!on_way_ || is_lost(ego, beside)) {
        const std::optional<std::uint32_t> lane = lane_under(ego);
        on_way_ = lane.has_value();
        if (!on_way_)
            return Found::nothing;
        found = Found::another;
        start_over(ego, {*lane}, 10);
    }
    if (new_lane_ && new_lane_at_once_)
        take_change(ego);
    // A new way begins on a lane's middle: one who is between two gets there first.
    if (!is_changing_lanes(ego)) {
        if (new_keeping_)
            take_keeping(ego);
        if (new_route_)
            take_route(ego);
        if (new_lane_)
            take_change(ego);
    }
    const double braking = ego.speed * ego.speed / (2 * comfortable_braking_);
    way_.extend(ego.front_s(), std::max(shortest_way, braking + braking_reserve));
    way_.drop_before(rear_axle_s_, way_behind);
    return found;
}

/// The lane that fits best; not one inside a junction that leads nowhere, where there is another.
std::optional<std::uint32_t> Navigator::lane_under(const Ego& ego) const {
    constexpr double around = 8;  // [m]
    const auto best = map_->lanes.best(ego.position, ego.yaw);
    const auto leads_on = [&](std::uint32_t lane) {
        return map_->town.lanes[lane].kind != world::LaneKind::internal ||
               map_->graph.exit(lane) != world::none;
    };
    if (best && leads_on(best->lane))
        return best->lane;
    std::optional<std::uint32_t> nearest;
    double least = world::infinity;
    for (const world::LaneMap::Found& found : map_->lanes.at(ego.position, around)) {
        const double yaw = world::point_at(map_->town.lanes[found.lane], found.at.s).yaw;
        const double turn = std::abs(world::wrap_angle(yaw - ego.yaw));
        const double cost = found.at.distance + 4 * turn;
        if (leads_on(found.lane) && turn < std::numbers::pi / 2 && cost < least) {
            least = cost;
            nearest = found.lane;
        }
    }
    return nearest;
}

double Navigator::beside_way(const Ego& ego) const {
    const PathPoint here = way_.path().at(ego.rear_axle_s);
    return world::cross(here.direction, (ego.position - here.position).head<2>());
}

bool Navigator::is_lost(const Ego& ego, double beside) const {
    const PathPoint here = way_.path().at(ego.rear_axle_s);
    const Eigen::Vector3d aside(-here.direction.y() * beside, here.direction.x() * beside, 0);
    const double distance = (ego.position - here.position - aside).norm();
    // Where a dead end ends one may stand beyond the path.
    const bool beyond = way_.ended() && ego.rear_axle_s >= way_.path().end() - Path::spacing;
    return !beyond && (distance > lost_distance || here.direction.dot(ego.direction) < -0.2);
}

/// A new path under the car: along `lanes`, of which the first is the one that we are on. Changes
/// of lanes start `change_room` ahead of the rear axle at the earliest.
void Navigator::start_over(Ego& ego,
                           const std::vector<std::uint32_t>& lanes_ahead,
                           double change_room) {
    const double before = rear_axle_s_;
    const double s = world::project(map_->town.lanes[lanes_ahead.front()], ego.position).s;
    way_.restart(lanes_ahead, {std::max(s - way_behind, 0.0), s, ego.speed, change_room});
    way_.extend(0, shortest_way);
    rear_axle_s_ = way_.path().project(ego.position, 0, 3 * way_behind);
    ego.rear_axle_s = rear_axle_s_;
    jump_ += rear_axle_s_ - before;
}

/// By the plan, not by where it is.
bool Navigator::is_changing_lanes(const Ego& ego) const {
    return std::any_of(way_.changes().begin(), way_.changes().end(), [&](const LaneChange& change) {
        return change.start < ego.rear_axle_s && ego.rear_axle_s < change.end;
    });
}

/// Lanes that we can no longer choose: those under the car, and what lies behind a junction that is
/// so near that we could not brake for another way_. A change of lanes that has not begun need not
/// be.
std::vector<std::uint32_t> Navigator::committed_lanes(const Ego& ego) const {
    const double braking = ego.speed * ego.speed / (2 * comfortable_braking_);
    double until = ego.front_s() + braking;
    const double from = ego.rear_axle_s;
    for (const LaneChange& change : way_.changes())
        if (change.start >= from)
            until = std::min(until, change.start);
    std::vector<std::uint32_t> lanes_on;
    bool inside = false;
    for (const PathPiece& piece : way_.pieces()) {
        if (piece.end < from)
            continue;
        if (!lanes_on.empty() && !inside && piece.start > until)
            break;
        inside = map_->town.lanes[piece.lane].kind == world::LaneKind::internal;
        if (!inside || lanes_on.empty())
            lanes_on.push_back(piece.lane);
    }
    return lanes_on;
}

/// Throws naming the stop that no way from this lane leads to.
void Navigator::require_way(std::uint32_t from,
                            std::span<const std::uint32_t> stops,
                            double last_s) const {
    const auto changes =
        way_.keeps_lane() ? world::LaneChanges::forbidden : world::LaneChanges::allowed;
    const Plan plan = map_->graph.plan({from, 0}, stops, last_s, changes);
    if (plan.unreachable != world::none)
        throw world::Error("route: no way leads from lane '" + map_->town.lanes[from].name +
                           "' to lane '" + map_->town.lanes[plan.unreachable].name + "'" +
                           (way_.keeps_lane() ? " without a change of lanes" : ""));
}

/// What is left of the route is planned anew from the lanes that we cannot leave any more.
void Navigator::take_keeping(Ego& ego) {
    new_keeping_.reset();
    const std::vector<std::uint32_t> lanes_ahead = committed_lanes(ego);
    std::span<const std::uint32_t> stops = way_.stops();
    for (const std::uint32_t lane : lanes_ahead)
        if (!stops.empty() && stops.front() == lane)
            stops = stops.subspan(1);
    require_way(lanes_ahead.back(), stops, way_.last_s());
    start_over(ego, lanes_ahead, ego.model->length + 0.5 * ego.speed);
}

void Navigator::take_route(Ego& ego) {
    const std::vector<std::uint32_t> lanes_ahead = committed_lanes(ego);
    std::span<const std::uint32_t> stops = new_route_->stops;
    for (const std::uint32_t lane : lanes_ahead)
        if (!stops.empty() && stops.front() == lane)
            stops = stops.subspan(1);
    require_way(lanes_ahead.back(), stops, new_route_->last_s);
    way_.set_stops(std::move(new_route_->stops), new_route_->last_s);
    new_route_.reset();
    start_over(ego, lanes_ahead, ego.model->length + 0.5 * ego.speed);
}

/// To the neighbour of the lane that we are on. Too late where we are about to leave it: then we go
/// on. Another lane is a place to go to.
void Navigator::take_change(Ego& ego) {
    const std::uint32_t wanted = *new_lane_;
    new_lane_.reset();
    if (new_lane_at_once_) {
        start_over(ego, {wanted}, ego.model->length + 0.5 * ego.speed);
        return;
    }
    std::vector<std::uint32_t> lanes_ahead = committed_lanes(ego);
    const auto is_beside = [&](std::uint32_t lane) {
        return wanted == map_->town.lanes[lane].left || wanted == map_->town.lanes[lane].right;
    };
    if (is_beside(lanes_ahead.back())) {
        lanes_ahead.push_back(wanted);
        start_over(ego, lanes_ahead, ego.model->length + 0.5 * ego.speed);
    } else if (std::none_of(lanes_ahead.begin(), lanes_ahead.end(), is_beside)) {
        new_route_ = {{wanted}, map_->town.lanes[wanted].length};
        take_route(ego);
    }
}

void Navigator::start_on(std::uint32_t lane, Ego& ego) {
    start_over(ego, {lane_under(ego).value_or(lane)}, ego.model->length);
    on_way_ = true;
}

void Navigator::put_off_change(double distance, Ego& ego) {
    const double front = ego.front_s() - ego.rear_axle_s;
    start_over(ego, way_.lanes_to_come(ego.rear_axle_s), front + distance);
}

void Navigator::add_to(world::Hasher& hasher) const {
    way_.add_to(hasher);
    hasher.add(new_route_.has_value());
    if (new_route_) {
        hasher.add(std::span<const std::uint32_t>(new_route_->stops));
        hasher.add(new_route_->last_s);
    }
    hasher.add(new_lane_.value_or(world::none));
    if (new_lane_ && new_lane_at_once_)
        hasher.add(true);
    if (new_keeping_)
        hasher.add(*new_keeping_);
    hasher.add(rear_axle_s_);
    hasher.add(on_way_);
}

}  // namespace reprise::drivers
