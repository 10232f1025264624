#include "drivers/to_and_fro.h"

#include <algorithm>
#include <cmath>

#include "drivers/turning_room.h"
#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::drivers {

namespace {

constexpr double inching = 0.7;          // [m/s]
constexpr double kept_clear = 0.25;      // [m] kept from everybody
constexpr double looks_on = 0.35;        // [m]
constexpr double stops_with = 1.5;       // [m/s^2]
constexpr double steepest = 0.75;        // [rad] to its way
constexpr double turns_per_metre = 0.5;  // [rad] for each metre beside the line
constexpr double lock_gain = 3;
constexpr double lane_edge = 1.7;  // [m] from its middle: as far as the tail may reach
constexpr std::uint32_t most_gears = 14;
constexpr double longest_halt = 8;       // [s] of standing
constexpr double there = 0.3;            // [m] beside the line,
constexpr double straight_again = 0.15;  // [rad] and askew of it

}  // namespace

void ToAndFro::begin(const Eigen::Vector2d& origin,
                     const Eigen::Vector2d& direction,
                     double aside) {
    on_ = true;
    out_ = false;
    origin_ = origin;
    direction_ = direction;
    aside_ = aside;
    forward_ = true;
    gear_changes_ = standing_ticks_ = 0;
}

/// As in Control, ahead.
double ToAndFro::steer_to_line(double beside, double heading, const Ego& ego) const {
    const double wanted = std::clamp(turns_per_metre * (aside_ - beside), -steepest, steepest);
    return std::clamp(lock_gain * (wanted - heading) / ego.model->max_steering_angle, -1.0, 1.0);
}

/// Is somebody where it comes to before it stands, in this gear?
bool ToAndFro::is_shut(const world::TickView& last, const Ego& ego, double steer) const {
    const double speed = std::abs(ego.speed);
    const double reach = looks_on + 0.15 * speed + speed * speed / (2 * stops_with);
    return comes_near(
        last, ego, forward_ ? reach : -reach, steer * ego.model->max_steering_angle, kept_clear);
}

/// On the side that it turns away from.
bool ToAndFro::tail_leaves_lane(double beside, double heading, const Ego& ego) const {
    const double side = aside_ > 0 ? 1 : -1;
    const double turned = side * heading;
    const double corner = -side * beside + ego.model->rear_overhang * std::sin(turned) +
                          ego.model->width / 2 * std::cos(turned);
    return corner > lane_edge;
}

void ToAndFro::change_gear() {
    forward_ = !forward_;
    ++gear_changes_;
}

ToAndFro::Move ToAndFro::next(const world::TickView& last, const Ego& ego) {
    constexpr double wheels_are_turned = 0.1;  // [rad]
    const double side = aside_ > 0 ? 1 : -1;
    const double heading = world::wrap_angle(ego.yaw - std::atan2(direction_.y(), direction_.x()));
    const double beside = world::cross(direction_, ego.position.head<2>() - origin_);
    const bool stands = std::abs(ego.speed) < 0.05;
    standing_ticks_ = stands ? standing_ticks_ + 1 : 0;
    out_ = std::abs(aside_ - beside) < there && std::abs(heading) < straight_again;
    if (out_ || gear_changes_ > most_gears || standing_ticks_ * step_ > longest_halt) {
        on_ = false;
        return {};
    }
    const double steer = forward_ ? steer_to_line(beside, heading, ego) : -side;
    const bool turned =
        std::abs(ego.steering_angle - steer * ego.model->max_steering_angle) < wheels_are_turned;
    const bool far_enough =
        !forward_ && (side * heading > steepest || tail_leaves_lane(beside, heading, ego));
    if (far_enough || is_shut(last, ego, steer)) {
        if (stands && turned)
            change_gear();
        return {0, steer};
    }
    if (!turned && stands)
        return {0, steer};
    return {forward_ ? inching : -inching, steer};
}

void ToAndFro::add_to(world::Hasher& hasher) const {
    if (!on_)
        return;
    for (const double number : {origin_.x(), origin_.y(), direction_.x(), direction_.y(), aside_})
        hasher.add(number);
    hasher.add(forward_);
    hasher.add(gear_changes_);
    hasher.add(standing_ticks_);
}

}  // namespace reprise::drivers
