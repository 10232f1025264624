// The built-in driver: how fast the road and the scenario let it drive.
#include <algorithm>
#include <cmath>

#include "drivers/control/steering.h"
#include "drivers/driver_state.h"
#include "drivers/lane_change.h"
#include "drivers/turning_room.h"
#include "world/frames.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double speed_gain = 0.8;   // [1/s]
constexpr double exact_gain = 3;     // [1/s] of one who is told a speed and when
constexpr double longest_wait = 12;  // [s] for room on the next lane

}  // namespace

/// Of one who keeps to an ordered speed, or to the changing of one. [m/s^2]
double DriverState::ordered_acceleration(const Ego& ego) const {
    const SpeedOrder::Wish wish = speed_order.wish(tick, step);
    return wish.acceleration + exact_gain * (wish.speed - ego.speed);
}

/// Before the path leaves our lane: is there room on the other one? If not, leave it later, and at
/// the latest place wait.
double DriverState::change_lanes(const world::TickView& last, Ego& ego) {
    for (const LaneChange& change : way().changes()) {
        const double before = change.start - ego.front_s();
        if (before < 0 || before > 2 + ego.speed)
            continue;
        if (is_clear(last, ego, town(), change.to) || waiting_ticks * step > longest_wait) {
            if (before < 1)
                waiting_ticks = 0;
            return world::infinity;
        }
        if (change.spare > 5) {
            const double later = before + std::min(5 + ego.speed, change.spare);
            navigator.put_off_change(later, ego);
            return world::infinity;
        }
        waiting_ticks += ego.speed < 0.5 ? 1 : 0;
        return stop_acceleration(before, ego.speed, style.comfortable_braking, style);
    }
    return world::infinity;
}

/// The steepest way down of what is seen of the road, as a sine; 0 where it only rises.
double DriverState::descent(const Ego& ego) const {
    constexpr double sight = 60;     // [m]
    constexpr double look_step = 4;  // [m]
    const Path& path = way().path();
    double steepest = 0;
    for (double ahead = 0; ahead <= sight; ahead += look_step)
        steepest = std::max(steepest, -path.climb(ego.rear_axle_s + ahead, look_step / 2));
    return steepest;
}

/// The speed that lanes, curves and the scenario's cap allow, and dead ends. [m/s^2]
double DriverState::cruise(const Ego& ego) const {
    const Path& path = way().path();
    const bool changing = speed_order.is_changing(tick, step);
    const double cap = changing ? speed_order.wish(tick, step).speed : speed_order.target();
    // A glance ahead makes up for the tick's delay.
    const double middle = ego.model->wheelbase / 2;
    const double s = ego.rear_axle_s + middle + ego.speed * step;
    const auto squared_speed = [&](double at) {
        const double most = path.at(at).squared_speed;
        return style.share *
               (has_wide_turn ? std::min(most, wide_turn->at(at - middle).squared_speed) : most);
    };
    const double here = squared_speed(s);
    const double allowed = std::sqrt(here);
    double acceleration = speed_gain * (std::min(allowed, cap) - ego.speed);
    if (allowed < cap && ego.speed > allowed - 1) {
        acceleration +=
            std::clamp((squared_speed(s + 1) - here) / 2, -style.comfortable_braking, 0.0);
    }
    acceleration = std::clamp(acceleration, -4 * style.share, style.acceleration);
    if (changing) {
        const double as_told = ordered_acceleration(ego);
        // A change takes what it takes, as long as the road allows the speed.
        acceleration = cap < allowed ? as_told : std::min(acceleration, as_told);
    }
    return std::min(acceleration, ended_acceleration(ego));
}

/// Who is not on his line, as one that was pushed or put askew of his way, gets onto it slowly: at
/// a greater speed wheels turn too late, and he would weave. [m/s^2]
double DriverState::off_line(const Ego& ego) const {
    constexpr double askew = 0.45;  // [rad]
    constexpr double far = 1.2;     // [m]
    constexpr double slow = 2.5;    // [m/s]
    constexpr double gain = 1;      // [1/s]
    constexpr double braking = 2;   // [m/s^2]
    const double s = ego.rear_axle_s;
    const double yaw = has_wide_turn ? wide_turn->at(s).yaw : way().path().at(s).yaw;
    const double on_line =
        passing.plan() ? passing.plan()->bypass.offset(s + tracked_ahead(*ego.model)) : 0;
    if (std::abs(world::wrap_angle(ego.yaw - yaw)) < askew &&
        std::abs(tracked_beside(ego) - on_line) < far)
        return world::infinity;
    return std::max(gain * (slow - ego.speed), -braking * style.share);
}

/// Before the end of the road. [m/s^2]
double DriverState::ended_acceleration(const Ego& ego) const {
    if (!way().ended())
        return world::infinity;
    return stop_acceleration(
        way().path().end() - ego.front_s() - 1, ego.speed, style.comfortable_braking, style);
}

/// Stops where a turn begins that takes going back and forth, and begins it. [m/s^2]
double DriverState::approach_turn(const world::TickView& last, const Ego& ego) {
    constexpr double sight = 80;             // [m]
    constexpr double room_for_another = 7;   // [m] to and fro
    constexpr std::uint32_t patience = 600;  // ticks: who stands for longer may be a wreck
    const auto ahead = std::find_if(way().gates().begin(),
                                    way().gates().end(),
                                    [&](const Gate& gate) { return gate.s > ego.front_s() - 1; });
    if (ahead == way().gates().end() || ahead->turn != world::Turn::around ||
        ahead->s > ego.front_s() + sight)
        return world::infinity;
    const world::Link& link = town().lanes[ahead->from].links[ahead->link];
    const auto street = TurnAround::street_of(town(), ahead->from, link, *ego.model);
    if (!street)
        return world::infinity;
    const double distance = ahead->s - TurnAround::before_end - ego.front_s();
    if (!turns_around_at(last, ego, street->origin, street->yaw)) {
        turner_ticks = 0;
    } else if (turner_ticks < patience) {
        turner_ticks += ego.speed < 0.5 ? 1 : 0;
        return stop_acceleration(
            distance - room_for_another, ego.speed, style.comfortable_braking, style);
    }
    const double acceleration =
        stop_acceleration(distance, ego.speed, style.comfortable_braking, style);
    // Stopped a little short of it, for a car say, it would not move on for so short a way.
    const bool stays = ego.speed < 0.02 && acceleration < Pedals::least_to_start;
    if ((distance < 0.7 && ego.speed < 0.2) || stays) {
        turn_around.begin(*street, ego);
        turns_into = ahead->to;
    }
    return acceleration;
}

/// A way that begins inside a junction, as behind a step back, may begin in the middle of a turn
/// around: what is left of that takes going back and forth as well.
void DriverState::resume_turn(const Ego& ego) {
    constexpr double rest = 0.6;  // [rad] of it; with less the path does it
    constexpr double slow = 2;    // [m/s]
    const world::LaneT& inside = town().lanes[way().lanes().front()];
    if (inside.kind != world::LaneKind::internal || std::abs(ego.speed) > slow ||
        inside.links.empty() || inside.links.front().turn() != world::Turn::around ||
        speed_order.reacts_to_nothing())
        return;
    const std::uint32_t exit = inside.links.front().to();
    for (std::uint32_t from = 0; from < town().lanes.size(); ++from)
        for (const world::Link& link : town().lanes[from].links) {
            if (town().lanes[from].kind == world::LaneKind::internal || link.to() != exit)
                continue;
            const auto street = TurnAround::street_of(town(), from, link, *ego.model);
            if (!street || std::abs(world::wrap_angle(ego.yaw - street->yaw)) < rest)
                continue;
            turn_around.begin(*street, ego);
            turns_into = exit;
            return;
        }
}

}  // namespace reprise::drivers
