#include "drivers/control/turn_around.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::drivers {

namespace {

constexpr double creep = 1.3;                // [m/s]
constexpr double braking = 1.5;              // [m/s^2]
constexpr double manoeuvre_reaction = 0.15;  // [s]
constexpr double aligned = 0.35;             // [rad] the path does the rest
constexpr double straight_enough = 0.15;     // [rad] backwards
constexpr double looks_ahead = 1.2;          // [m]
constexpr double looks_ahead_at_last = 0.3;  // [m] of one who has waited,
constexpr std::uint32_t patience = 60;       // for so many ticks
constexpr double keeps_clear = 0.5;          // [m]
constexpr std::uint32_t most_changes = 16;   // of gear: then the street is narrower than it seemed
constexpr double spare = 0.6;                // [m] of a street's width beyond the car's length

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

/// Is a body of this length and width near the box that the car fills and will fill? Who is behind
/// the end that follows is not.
bool is_near(const Ego& ego,
             double ahead,
             const Eigen::Vector2d& rear_axle,
             const Eigen::Vector2d& direction,
             const world::VehicleModel& model) {
    const double reach = model.width / 2 + keeps_clear;
    const double rear = -ego.model->rear_overhang + (ahead > 0 ? reach : ahead);
    const double front =
        ego.model->length - ego.model->rear_overhang + (ahead > 0 ? ahead : -reach);
    for (double along = -model.rear_overhang; along < model.length - model.rear_overhang;
         along += 1) {
        const Eigen::Vector2d offset = rear_axle + along * direction - ego.position.head<2>();
        const double x = ego.direction.dot(offset);
        const double y = ego.direction.x() * offset.y() - ego.direction.y() * offset.x();
        const double dx = std::max({rear - x, x - front, 0.0});
        const double dy = std::max(std::abs(y) - ego.model->width / 2, 0.0);
        if (dx * dx + dy * dy < reach * reach)
            return true;
    }
    return false;
}

bool somebody_is_near(const world::TickView& last, const Ego& ego, double ahead) {
    constexpr double far = 15;
    const auto near = [&](const world::Vec3& p,
                          const Eigen::Vector2d& direction,
                          const world::VehicleModel& model) {
        const Eigen::Vector3d position = world::to_eigen(p);
        return (position - ego.position).squaredNorm() < far * far &&
               is_near(ego, ahead, position.head<2>(), direction, model);
    };
    const auto heading = [](float yaw) {
        return Eigen::Vector2d(std::cos(static_cast<double>(yaw)),
                               std::sin(static_cast<double>(yaw)));
    };
    world::VehicleModel walker{};
    walker.length = walker.width = 0.6;
    walker.rear_overhang = 0.3;
    return std::any_of(last.vehicles().begin(),
                       last.vehicles().end(),
                       [&](const world::VehicleState& other) {
                           const Ego seen = ego_of(other);
                           return seen.id != ego.id &&
                                  near(other.position(), seen.direction, *seen.model);
                       }) ||
           std::any_of(last.cars().begin(),
                       last.cars().end(),
                       [&](const world::CarState& car) {
                           return near(car.position(),
                                       heading(car.yaw()),
                                       world::vehicle_models()[car.model()]);
                       }) ||
           std::any_of(
               last.walkers().begin(), last.walkers().end(), [&](const world::WalkerState& one) {
                   return near(one.position(), heading(one.yaw()), walker);
               });
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

/// How far the end that leads, in that gear, is beyond the kerb that it turns towards, after so
/// many metres with full lock. [m]
double TurnAround::beyond_kerbs(const Ego& ego, double distance, bool forward) const {
    const double lock = (forward ? side_ : -side_) * ego.model->max_steering_angle;
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

/// Has it waited for long enough, and is there room the other way?
bool TurnAround::goes_the_other_way(const world::TickView& last, const Ego& ego) const {
    constexpr double worth_it = 0.3;  // [m]
    const double sign = forward_ ? -1 : 1;
    return waiting_ticks_ > patience && std::abs(ego.speed) < 0.1 &&
           beyond_kerbs(ego, sign * worth_it, !forward_) <= 0 &&
           !somebody_is_near(last, ego, sign * looks_ahead);
}

void TurnAround::change_gear() {
    forward_ = !forward_;
    ++gear_changes_;
    waiting_ticks_ = 0;
}

TurnAround::Move TurnAround::next(const world::TickView& last, const Ego& ego) {
    const double error = std::abs(world::wrap_angle(ego.yaw - street_.yaw));
    const double along = forward_ ? ego.speed : -ego.speed;
    const double speed = std::max(along, 0.0);
    const double stopping = 0.05 + manoeuvre_reaction * speed + speed * speed / (2 * braking);
    const double sign = forward_ ? 1 : -1;
    done_ = (forward_ && error < aligned) || gear_changes_ > most_changes;
    const bool at_kerb = beyond_kerbs(ego, sign * stopping, forward_) > 0;
    if (at_kerb || (!forward_ && error < straight_enough)) {
        if (std::abs(ego.speed) < 0.1)
            change_gear();
        return {0, sign * side_};
    }
    const double steer = sign * side_;
    const bool wheels_turned =
        std::abs(ego.steering_angle - steer * ego.model->max_steering_angle) < 0.1;
    bool is_blocked = somebody_is_near(last, ego, sign * looks_ahead);
    if (is_blocked && goes_the_other_way(last, ego)) {
        change_gear();
        return {0, -steer};
    }
    waiting_ticks_ += is_blocked ? 1 : 0;
    if (waiting_ticks_ > patience)
        is_blocked = somebody_is_near(last, ego, sign * looks_ahead_at_last);
    if (is_blocked || (!wheels_turned && along < 0.3))
        return {0, steer};
    return {sign * creep, steer};
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
