#include "drivers/control/pedals.h"

#include <algorithm>
#include <cmath>

namespace reprise::drivers {

namespace {

constexpr double settling = 0.5;       // [s] of the last metre before a stop
constexpr double approach_gain = 1.2;  // [1/s]
constexpr double braking_beyond = 3;   // [m/s^2] more than this only to avoid a collision
constexpr double used_grip = 0.6;      // share of the tyres' grip, in comfort
constexpr double least_share = 0.05;   // where the road is as steep as it is slippery

}  // namespace

DrivingStyle style_on(double road_friction, double descent, const world::CarModel& car) {
    DrivingStyle style;
    const double left = road_friction * car.grip - std::max(descent, 0.0);
    const double comfort = used_grip * left * world::gravity;
    style.share = std::clamp(comfort / style.comfortable_braking, least_share, 1.0);
    style.acceleration *= style.share;
    style.comfortable_braking *= style.share;
    style.time_gap /= style.speed_share();
    return style;
}

double stop_acceleration(double distance, double speed, double comfort, const DrivingStyle& style) {
    if (distance <= 0)
        return speed > 0.5 ? -style.hardest_braking : -comfort;
    const double soft = comfort * settling;
    const double envelope = std::sqrt(soft * soft + 2 * comfort * distance) - soft;
    const double wanted =
        approach_gain * (envelope - speed) - comfort * envelope / (envelope + soft);
    // Too fast for that: a tenth more than what is needed, not more.
    const double needed = std::max(speed * speed / (2 * distance), comfort);
    return std::max({wanted, -1.1 * needed, -style.hardest_braking});
}

double follow_acceleration(double gap,
                           double speed,
                           double leader_speed,
                           const DrivingStyle& style) {
    const double closing = speed - leader_speed;
    const double root = 2 * std::sqrt(style.acceleration * style.comfortable_braking);
    const double wish =
        style.standing_gap + std::max(0.0, speed * style.time_gap + speed * closing / root);
    const double ratio = wish / std::max(gap, 0.1);
    const double idm = style.acceleration * (1 - ratio * ratio);
    const double needed = closing > 0 ? closing * closing / (2 * std::max(gap - 1, 0.2)) : 0;
    return std::max(
        {idm, -std::max(braking_beyond * style.share, 1.3 * needed), -style.hardest_braking});
}

double travel_time(double distance, double speed, double acceleration, double top_speed) {
    if (distance <= 0)
        return 0;
    const double start = std::clamp(speed, 0.0, top_speed);
    const double ramp = (top_speed * top_speed - start * start) / (2 * acceleration);
    if (distance <= ramp)
        return (std::sqrt(start * start + 2 * acceleration * distance) - start) / acceleration;
    return (top_speed - start) / acceleration + (distance - ramp) / top_speed;
}

Pedals::Position Pedals::press(double wanted,
                               double speed,
                               double climb,
                               const world::CarModel& car,
                               double step,
                               Manner manner) {
    // What became of the last wish?
    if (started_ && !holding_ && !saturated_ && speed > 1) {
        const double got = (speed - last_speed_) / step;
        correction_ = std::clamp(correction_ + 0.6 * step * (asked_ - got), -2.0, 2.0);
    }
    last_speed_ = speed;
    started_ = true;

    // Jerk: gentle on the throttle, quicker on the brake, at once in need.
    if (wanted < -4 || manner == Manner::exact)
        asked_ = wanted;
    else
        asked_ = std::clamp(wanted, asked_ - 12 * step, asked_ + 5 * step);

    // Stand until there is a reason to go.
    if (holding_ ? wanted < least_to_start : (speed < 0.2 && wanted < 0.05)) {
        holding_ = true;
        asked_ = 0;
        return {0, 0.5};
    }
    holding_ = false;

    const world::VehicleModel& model = *car.catalogue;
    const double resistance =
        0.5 * world::air_density * model.drag_area * speed * speed +
        (speed > 0.1 ? car.rolling_resistance * model.mass * world::gravity : 0);
    const double force = model.mass * (asked_ + correction_ + world::gravity * climb) + resistance;
    Position pedals;
    if (force > 0) {
        const double most = world::drive_force(car, 1, false, std::max(speed, 0.0));
        pedals.throttle = std::min(force / most, 1.0);
    } else {
        pedals.brake = std::min(-force / (model.mass * car.brake_deceleration), 1.0);
    }
    saturated_ = pedals.throttle >= 1 || pedals.brake >= 1;
    return pedals;
}

world::Control rolling_control(
    std::uint32_t actor, const world::CarModel& car, double speed, double climb, double step) {
    const Pedals::Position pedals = Pedals().press(0, speed, climb, car, step);
    return {pedals.throttle, pedals.brake, 0, actor, 0, false, false};
}

void Pedals::add_to(world::Hasher& hasher) const {
    hasher.add(asked_);
    hasher.add(correction_);
    hasher.add(last_speed_);
    hasher.add(started_);
    hasher.add(holding_);
    hasher.add(saturated_);
}

}  // namespace reprise::drivers
