#include "drivers/turn_around.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/turning_room.h"
#include "world/frames.h"

namespace reprise::drivers {

namespace {

constexpr double creep = 1.3;                // [m/s]
constexpr double braking = 1.5;              // [m/s^2]
constexpr double manoeuvre_reaction = 0.15;  // [s]
constexpr double aligned = 0.35;             // [rad] the path does the rest
constexpr double straight_enough = 0.15;     // [rad] backwards
constexpr double looks_ahead = 1.2;          // [m]
constexpr double creep_at_last = 0.5;        // [m/s] of one who has waited
constexpr double looks_ahead_at_last = 0.4;  // [m]
constexpr std::uint32_t patient_for = 60;    // ticks
constexpr double keeps_clear = 0.5;          // [m]
constexpr double clear_at_last = 0.07;       // [m] beside who stays,
constexpr double clear_in_need = 0.02;       // [m] and of one who has waited for longer still
constexpr std::uint32_t most_changes = 16;   // of gear: then the street is narrower than it seemed
constexpr double spare = 0.6;                // [m] of a street's width beyond the car's length
constexpr double good_spare = 1;             // [m] with which it takes a few changes only
/// [m] that bumpers reach over a kerb for that: less than they are ahead of the wheels, and less
/// than signs stand beside the road.
constexpr double most_over_kerb = 0.45;

/// [m] from the centre line of a lane to the edge of the last lane on this side for cars that
/// drive the same way.
double to_edge(const world::TownT& town, std::uint32_t lane, std::uint32_t world::LaneT::*side) {
    double room = town.lanes[lane].width / 2;
    for (std::uint32_t next = town.lanes[lane].*side;
         next < town.lanes.size() && town.lanes[next].kind == world::LaneKind::driving;
         next = town.lanes[next].*side)
        room += town.lanes[next].width;
    return room;
}

Eigen::Vector2d turned(const Eigen::Vector2d& v, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

}  // namespace

std::optional<TurnAround::Street> TurnAround::street_of(const world::TownT& town,
                                                        std::uint32_t lane,
                                                        const world::Link& link,
                                                        const world::VehicleModel& model) {
    if (link.turn() != world::Turn::around || link.to() >= town.lanes.size())
        return std::nullopt;
    const world::LaneT& out = town.lanes[link.to()];
    const world::LanePoint place = world::point_at(out, std::min(before_end, out.length / 2));
    const Eigen::Vector3d from =
        world::point_at(town.lanes[lane], town.lanes[lane].length).position;
    const Eigen::Vector2d offset = (from - place.position).head<2>();
    const double side = -std::sin(place.yaw) * offset.x() + std::cos(place.yaw) * offset.y();
    // The rear axle's circle, and the lane that drives the other way.
    const double circle = 2 * model.wheelbase / std::tan(model.max_steering_angle);
    if (std::abs(side) > circle)
        return std::nullopt;
    Street street{place.position.head<2>(), place.yaw, 0, 0, 0};
    const Eigen::Vector3d along =
        world::point_at(out, std::min(2 * before_end, out.length)).position -
        world::point_at(out, 0).position;
    if (along.norm() > 0)
        street.climb = along.z() / along.norm();
    const auto left = &world::LaneT::left;
    const auto right = &world::LaneT::right;
    street.left = side > 0 ? side + to_edge(town, lane, right) : to_edge(town, link.to(), left);
    street.right = side > 0 ? to_edge(town, link.to(), right) : -side + to_edge(town, lane, left);
    const double lacks = model.length + good_spare - street.left - street.right;
    const double over_kerb = std::clamp(lacks / 2, 0.0, most_over_kerb);
    street.left += over_kerb;
    street.right += over_kerb;
    if (street.left + street.right < model.length + spare)
        return std::nullopt;
    return street;
}

void TurnAround::begin(const Street& street, const Ego& ego) {
    street_ = street;
    const Eigen::Vector2d offset = ego.position.head<2>() - street.origin;
    side_ = -std::sin(street.yaw) * offset.x() + std::cos(street.yaw) * offset.y() > 0 ? 1 : -1;
    forward_ = true;
    done_ = false;
    gear_changes_ = waiting_ticks_ = 0;
}

/// [rad] of the front wheels, with so much of full lock in that gear.
double TurnAround::lock(const Ego& ego, bool forward, double share) const {
    return (forward ? share : -share) * side_ * ego.model->max_steering_angle;
}

/// How far the end that leads, in that gear, is beyond the kerb that it turns towards, after so
/// many metres with so much of full lock. [m]
double TurnAround::beyond_kerbs(const Ego& ego, double distance, bool forward, double share) const {
    const double lock = this->lock(ego, forward, share);
    const double turn = distance * std::tan(lock) / ego.model->wheelbase;
    const Eigen::Vector2d direction = turned(ego.direction, turn);
    const Eigen::Vector2d rear_axle =
        ego.position.head<2>() + distance * turned(ego.direction, turn / 2);
    const double end =
        forward ? ego.model->length - ego.model->rear_overhang : -ego.model->rear_overhang;
    const Eigen::Vector2d normal(-std::sin(street_.yaw), std::cos(street_.yaw));
    double most = -1e9;
    for (const double half_width : {-ego.model->width / 2, ego.model->width / 2}) {
        const Eigen::Vector2d corner =
            rear_axle + end * direction + half_width * turned(direction, std::numbers::pi / 2);
        const double y = normal.dot(corner - street_.origin);
        // Ahead it goes to the kerb of the new lane, back to that of the old one.
        const bool to_right = forward == (side_ > 0);
        most = std::max(most, to_right ? -y - street_.right : y - street_.left);
    }
    return most;
}

/// [m] that it can drive in that gear, with so much of full lock, before its leading end is at the
/// kerb; at most `most`.
double TurnAround::room(const Ego& ego, bool forward, double share, double most) const {
    constexpr double pace = 0.1;  // [m]
    double room = 0;
    while (room < most &&
           beyond_kerbs(ego, forward ? room + pace : -room - pace, forward, share) <= 0)
        room += pace;
    return std::min(room, most);
}

/// Does it come around from here without changing gear again? Who goes back for longer than that
/// ends in the lane that he comes from.
bool TurnAround::comes_around(const Ego& ego) const {
    const double left = std::abs(world::wrap_angle(ego.yaw - street_.yaw));
    const double arc = left * ego.model->wheelbase / std::tan(ego.model->max_steering_angle);
    return room(ego, true, 1, arc) >= arc;
}

/// Is somebody in the way of what it can drive in that gear?
bool TurnAround::meets_somebody(const world::TickView& last, const Ego& ego, bool forward) const {
    const double distance = room(ego, forward, 1, looks_ahead);
    return comes_near(
        last, ego, forward ? distance : -distance, lock(ego, forward, 1), keeps_clear);
}

/// Has it waited for long enough, and is there room the other way?
bool TurnAround::goes_the_other_way(const world::TickView& last, const Ego& ego) const {
    constexpr double worth_it = 0.3;  // [m]
    return waiting_ticks_ > patient_for && std::abs(ego.speed) < 0.1 &&
           room(ego, !forward_, 1, worth_it) >= worth_it && !meets_somebody(last, ego, !forward_);
}

void TurnAround::change_gear() {
    forward_ = !forward_;
    ++gear_changes_;
    waiting_ticks_ = 0;
}

/// Who stays may leave room for less than full lock: how much of it, the more the better. None:
/// there is no room.
std::optional<double> TurnAround::lock_that_passes(const world::TickView& last,
                                                   const Ego& ego) const {
    const double clear = waiting_ticks_ > 3 * patient_for ? clear_in_need : clear_at_last;
    for (const double share : {1.0, 0.5, 0.0}) {
        const double distance = room(ego, forward_, share, looks_ahead_at_last);
        if (distance > 0 &&
            !comes_near(
                last, ego, forward_ ? distance : -distance, lock(ego, forward_, share), clear))
            return share;
    }
    return std::nullopt;
}

TurnAround::Move TurnAround::next(const world::TickView& last, const Ego& ego) {
    const double error = std::abs(world::wrap_angle(ego.yaw - street_.yaw));
    const double along = forward_ ? ego.speed : -ego.speed;
    const double speed = std::max(along, 0.0);
    const double stopping = 0.05 + manoeuvre_reaction * speed + speed * speed / (2 * braking);
    const double sign = forward_ ? 1 : -1;
    done_ = (forward_ && error < aligned) || gear_changes_ > most_changes;
    const bool at_kerb = beyond_kerbs(ego, sign * stopping, forward_, 1) > 0;
    if (at_kerb || (!forward_ && (error < straight_enough || comes_around(ego)))) {
        if (std::abs(ego.speed) < 0.1)
            change_gear();
        return {0, sign * side_};
    }
    double steer = sign * side_;
    double wanted = creep;
    bool is_blocked = meets_somebody(last, ego, forward_);
    if (is_blocked && goes_the_other_way(last, ego)) {
        change_gear();
        return {0, -steer};
    }
    waiting_ticks_ += is_blocked ? 1 : 0;
    if (is_blocked && waiting_ticks_ > patient_for) {
        const std::optional<double> share = lock_that_passes(last, ego);
        is_blocked = !share;
        steer *= share.value_or(1);
        wanted = creep_at_last;
    }
    const bool wheels_turned =
        std::abs(ego.steering_angle - steer * ego.model->max_steering_angle) < 0.1;
    if (is_blocked || (!wheels_turned && along < 0.3))
        return {0, steer};
    return {sign * wanted, steer};
}

double TurnAround::climb(const Ego& ego) const {
    return street_.climb *
           ego.direction.dot(Eigen::Vector2d(std::cos(street_.yaw), std::sin(street_.yaw)));
}

void TurnAround::add_to(world::Hasher& hasher) const {
    hasher.add(done_);
    if (done_)
        return;
    for (const double number :
         {street_.origin.x(), street_.origin.y(), street_.yaw, street_.left, street_.right, side_})
        hasher.add(number);
    hasher.add(forward_);
    hasher.add(gear_changes_);
    if (waiting_ticks_ > 0)
        hasher.add(waiting_ticks_);
}

}  // namespace reprise::drivers
