#include "drivers/back_off.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drivers/bodies.h"
#include "world/frames.h"

namespace reprise::drivers {

namespace {

constexpr double patience_pushing = 2;   // [s]
constexpr double contact_memory = 0.5;   // [s] contacts come and go
constexpr double held = 0.3;             // [m/s] slower than this is not moving
constexpr double least_throttle = 0.03;  // of one who wants to go on
constexpr double least_impulse = 5;      // [N s] of a tick in contact
constexpr double first_distance = 3;     // [m]
constexpr double more_each_time = 2;     // [m]
constexpr std::uint32_t most_more = 3;
constexpr double forgotten_after = 20;  // [s] without contact
constexpr double backwards = 1.2;       // [m/s]
constexpr double behind_clear = 0.5;    // [m] kept from those behind
constexpr double behind_braking = 1.5;  // [m/s^2]
constexpr double lets_go_for = 6;       // [s] the other one, who takes a while to start
constexpr double lets_go_longest = 20;  // [s] while somebody moves ahead
constexpr double gives_up = 3;          // [s] of standing while it wants back
constexpr double turn_of_tail = 0.3;    // [rad] for each metre beside the path
constexpr double most_turn = 0.5;       // [rad]
constexpr double turn_gain = 2;
constexpr double behind_bend = 4;        // [m] before its front axle
constexpr double longest_turn = 6;       // [m] driven
constexpr double turned_enough = 0.3;    // [rad]
constexpr double nose_room = 0.8;        // [m] that the nose swings out, about
constexpr double nearly_straight = 0.1;  // [rad] of the wheels
constexpr double patience_circling = 6;  // [s]
constexpr double full_lock = 0.95;       // share of the steering
constexpr double getting_on = 1;         // [m]

}  // namespace

bool BackOff::notice(const world::TickView& last, const Ego& ego, double throttle) {
    const world::Measurement* measured = world::find(last.measurements(), ego.id);
    const double impulse = measured == nullptr
                               ? 0
                               : measured->impulse_vehicles() + measured->impulse_walkers() +
                                     measured->impulse_static();
    const bool contact = impulse - impulse_ > least_impulse;
    impulse_ = impulse;
    if (contact)
        free_ticks_ = 0;
    else if (tries_ > 0 || pushing_ticks_ > 0)
        ++free_ticks_;
    if (free_ticks_ * step_ > forgotten_after)
        tries_ = free_ticks_ = 0;
    if (going_back_)
        return false;
    const bool touches = contact || (pushing_ticks_ > 0 && free_ticks_ * step_ < contact_memory);
    const bool pushes = touches && throttle > least_throttle && std::abs(ego.speed) < held;
    pushing_ticks_ = pushes ? pushing_ticks_ + 1 : 0;
    if (pushing_ticks_ * step_ < patience_pushing)
        return false;
    begin(first_distance + more_each_time * std::min(tries_, most_more), ego);
    ++tries_;
    return true;
}

bool BackOff::notice_circling(const Ego& ego, double s, double steer) {
    const bool turns = std::abs(steer) > full_lock && ego.speed > 0.1;
    if (!turns || circling_ticks_ == 0 || std::abs(s - circling_from_) > getting_on) {
        circling_ticks_ = turns ? 1 : 0;
        circling_from_ = s;
        return false;
    }
    ++circling_ticks_;
    if (circling_ticks_ * step_ < patience_circling)
        return false;
    begin(first_distance + more_each_time * std::min(tries_, most_more), ego);
    ++tries_;
    return true;
}

bool BackOff::make_room(double distance, const world::TickView& last, const Ego& ego) {
    if (going_back_ || tries_ >= most_more || leaves_its_lanes(ego) ||
        somebody_is_behind(last, ego))
        return false;
    begin(distance, ego);
    ++tries_;
    return true;
}

bool BackOff::turn_on(double distance, const world::TickView& last, const Ego& ego) {
    if (!make_room(distance, last, ego))
        return false;
    turns_on_ = true;
    return true;
}

bool BackOff::give_room(double distance, const world::TickView& last, const Ego& ego) {
    if (!make_room(distance, last, ego))
        return false;
    lets_go_first_ = true;
    return true;
}

void BackOff::end() {
    going_back_ = steers_on_ = false;
    pushing_ticks_ = 0;
}

void BackOff::begin(double distance, const Ego& ego) {
    going_back_ = true;
    distance_ = distance;
    from_ = ego.position.head<2>();
    pushing_ticks_ = standing_ticks_ = circling_ticks_ = 0;
    free_ticks_ = waiting_ticks_ = 0;
    lets_go_first_ = turns_on_ = steers_on_ = false;
}

/// [rad] that the car still has to turn, to look where the path goes behind the bend.
double BackOff::turn_behind_bend(const Ego& ego, const Path& path, double s) {
    return world::wrap_angle(path.at(s + ego.model->wheelbase + behind_bend).yaw - ego.yaw);
}

std::optional<double> BackOff::steer_on(const Ego& ego, const Path& path, double s) {
    if (!steers_on_)
        return std::nullopt;
    const double turn = turn_behind_bend(ego, path, s);
    steers_on_ =
        (ego.position.head<2>() - from_).norm() < longest_turn && std::abs(turn) > turned_enough;
    if (!steers_on_)
        return std::nullopt;
    return std::clamp(turn_gain * turn / ego.model->max_steering_angle, -1.0, 1.0);
}

bool BackOff::somebody_is_behind(const world::TickView& last, const Ego& ego) const {
    const double speed = std::max(-ego.speed, 0.0);
    const double reach = behind_clear + 0.2 * speed + speed * speed / (2 * behind_braking);
    const double half = ego.model->width / 2 + 0.3;
    world::Box around;
    around.take(ego.position.head<2>(), 15);
    std::vector<Body> bodies;
    collect_bodies(last, ego.id, around, 0, bodies);
    const Eigen::Vector2d left(-ego.direction.y(), ego.direction.x());
    constexpr double look_step = 0.4;  // [m]
    return std::any_of(bodies.begin(), bodies.end(), [&](const Body& one) {
        if (std::abs(one.z - ego.position.z()) > world::level_clearance)
            return false;
        const Body body = one.seen_in_steps(ego.direction, look_step);
        // Those who come nearer count farther away.
        const double closing = std::max(body.velocity.dot(ego.direction), 0.0);
        for (double back = ego.model->rear_overhang + 0.3;
             back < ego.model->rear_overhang + reach + 1.5 * closing;
             back += look_step)
            if (body.meets(ego.position.head<2>() - back * ego.direction, half * left))
                return true;
        return false;
    });
}

bool BackOff::somebody_moves_ahead(const world::TickView& last, const Ego& ego) const {
    constexpr double near = 8;     // [m] before the bumper, as far as the other one's middle
    constexpr double moves = 0.1;  // [m/s]
    const double front = ego.model->length - ego.model->rear_overhang;
    const Eigen::Vector2d nose = ego.position.head<2>() + front * ego.direction;
    world::Box around;
    around.take(nose, near);
    std::vector<Body> bodies;
    collect_bodies(last, ego.id, around, 0, bodies);
    return std::any_of(bodies.begin(), bodies.end(), [&](const Body& one) {
        const Eigen::Vector2d from_nose = one.centre - nose;
        return one.kind == BodyKind::vehicle && one.speed > moves &&
               std::abs(one.z - ego.position.z()) < world::level_clearance &&
               from_nose.dot(ego.direction) > 0 && from_nose.norm() < near + one.half_length;
    });
}

/// Its tail is about to? From off the road nothing leads back, and across other lanes it would
/// stand in the way of whom it makes room for. Who is there already may go on.
bool BackOff::leaves_its_lanes(const Ego& ego) const {
    constexpr double edge = 0.3;           // [m] beside them
    constexpr double soon = 0.4;           // [m]
    constexpr double against_them = -0.4;  // cosine
    const auto is_on_them = [&](double behind) {
        const Eigen::Vector2d back = behind * ego.direction;
        const Eigen::Vector3d place = ego.position - Eigen::Vector3d(back.x(), back.y(), 0);
        const auto lanes = map_->lanes.at(place, edge);
        return std::any_of(lanes.begin(), lanes.end(), [&](const world::LaneMap::Found& found) {
            const double yaw = world::point_at(map_->town.lanes[found.lane], found.at.s).yaw;
            return world::ahead_of(yaw).dot(ego.direction) > against_them;
        });
    };
    return is_on_them(0) && !is_on_them(ego.model->rear_overhang + soon);
}

/// Going back with the wheels turned, the nose swings out to the other side. `side`: 1 left, -1
/// right.
bool BackOff::somebody_is_beside_nose(const world::TickView& last,
                                      const Ego& ego,
                                      double side) const {
    world::Box around;
    around.take(ego.position.head<2>(), 10);
    std::vector<Body> bodies;
    collect_bodies(last, ego.id, around, 0, bodies);
    const Eigen::Vector2d out = side * Eigen::Vector2d(-ego.direction.y(), ego.direction.x());
    const Eigen::Vector2d middle_out = (ego.model->width / 2 + nose_room / 2) * out;
    const double front = ego.model->length - ego.model->rear_overhang;
    constexpr double look_step = 0.3;  // [m]
    return std::any_of(bodies.begin(), bodies.end(), [&](const Body& one) {
        if (std::abs(one.z - ego.position.z()) > world::level_clearance)
            return false;
        const Body body = one.seen_in_steps(ego.direction, look_step);
        for (double ahead = ego.model->wheelbase / 2; ahead < front + nose_room; ahead += look_step)
            if (body.meets(ego.position.head<2>() + ahead * ego.direction + middle_out,
                           nose_room / 2 * out))
                return true;
        return false;
    });
}

BackOff::Move BackOff::next(const world::TickView& last,
                            const Ego& ego,
                            const Path* path,
                            double s) {
    const double driven = (from_ - ego.position.head<2>()).dot(ego.direction);
    const bool done = driven > distance_ - 0.3 || standing_ticks_ * step_ > gives_up;
    if (waiting_ticks_ > 0 || (done && std::abs(ego.speed) < 0.1)) {
        ++waiting_ticks_;
        const double waited = waiting_ticks_ * step_;
        going_back_ =
            lets_go_first_ &&
            (waited < lets_go_for || (waited < lets_go_longest && somebody_moves_ahead(last, ego)));
        if (turns_on_) {
            steers_on_ = true;
            from_ = ego.position.head<2>();
        }
        return {};
    }
    Move move;
    if (path != nullptr) {
        const PathPoint here = path->at(s);
        const double beside =
            world::cross(here.direction, ego.position.head<2>() - here.position.head<2>());
        const double wanted =
            turns_on_ ? ego.yaw + turn_behind_bend(ego, *path, s)
                      : here.yaw + std::clamp(turn_of_tail * beside, -most_turn, most_turn);
        move.steer = std::clamp(
            -turn_gain * world::wrap_angle(wanted - ego.yaw) / ego.model->max_steering_angle,
            -1.0,
            1.0);
    }
    const bool straight = somebody_is_beside_nose(last, ego, move.steer > 0 ? -1 : 1);
    if (straight)
        move.steer = 0;
    const bool may_swing = straight && std::abs(ego.steering_angle) > nearly_straight;
    if (!done && !may_swing && !leaves_its_lanes(ego) && !somebody_is_behind(last, ego))
        move.speed = backwards;
    standing_ticks_ = std::abs(ego.speed) < 0.1 ? standing_ticks_ + 1 : 0;
    return move;
}

void BackOff::add_to(world::Hasher& hasher) const {
    if (impulse_ > 0)
        hasher.add(impulse_);
    for (const std::uint32_t ticks : {pushing_ticks_, free_ticks_, tries_})
        if (ticks > 0)
            hasher.add(ticks);
    if (circling_ticks_ > 0) {
        hasher.add(circling_ticks_);
        hasher.add(circling_from_);
    }
    if (steers_on_)
        hasher.add(steers_on_);
    if (going_back_)
        hasher.add(distance_);
    if (going_back_ || steers_on_) {
        hasher.add(from_.x());
        hasher.add(from_.y());
    }
    if (!going_back_)
        return;
    hasher.add(standing_ticks_);
    if (turns_on_)
        hasher.add(turns_on_);
    if (!lets_go_first_)
        return;
    hasher.add(lets_go_first_);
    hasher.add(waiting_ticks_);
}

}  // namespace reprise::drivers
