#include "drivers/speed_order.h"

#include <algorithm>
#include <cmath>

namespace reprise::drivers {

namespace {

constexpr double usual_change = 2;  // [m/s^2] of one who is told a speed and no time
constexpr double build_up = 0.3;    // [s] in which a braking comes to its strength

}  // namespace

void SpeedOrder::end_hold() {
    if (kind_ == Kind::hold)
        free();
}

void SpeedOrder::end_brake() {
    if (brakes())
        free();
}

void SpeedOrder::cap(world::Transition change) {
    free();
    kind_ = Kind::cap;
    change_ = change;
    change_.to = std::max(change.to, 0.0);
    has_begun_ = change.duration <= 0;
}

void SpeedOrder::hold(world::Transition change) {
    free();
    kind_ = Kind::hold;
    change_ = change;
    has_begun_ = false;
}

void SpeedOrder::brake(double deceleration) {
    free();
    kind_ = Kind::brake;
    deceleration_ = deceleration;
    has_begun_ = false;
}

bool SpeedOrder::is_changing(std::uint64_t tick, double step) const {
    return change_.duration > 0 &&
           static_cast<double>(tick - start_) * step < change_.duration + step / 2;
}

double SpeedOrder::target() const {
    switch (kind_) {
        case Kind::none:
            return world::infinity;
        case Kind::brake:
            return 0;
        case Kind::cap:
        case Kind::hold:
            break;
    }
    return change_.to;
}

void SpeedOrder::begin(std::uint64_t tick, double speed, double step) {
    if (has_begun_)
        return;
    has_begun_ = true;
    start_ = tick;
    change_.from = std::max(speed, 0.0);
    if (kind_ == Kind::hold && change_.duration <= 0) {
        change_.shape = world::Shape::linear;
        change_.duration = std::max(std::abs(change_.to - change_.from) / usual_change, step);
    }
}

double SpeedOrder::speed_after(double seconds) const {
    if (kind_ != Kind::brake)
        return change_.value(seconds);
    const double building = std::min(seconds, build_up);
    const double lost =
        deceleration_ * (building * building / (2 * build_up) + std::max(seconds - build_up, 0.0));
    return std::max(change_.from - lost, 0.0);
}

SpeedOrder::Wish SpeedOrder::wish(std::uint64_t tick, double step) const {
    if (kind_ == Kind::none)
        return {};
    const double seconds = static_cast<double>(tick - start_) * step;
    const double speed = speed_after(seconds);
    if (kind_ == Kind::brake && speed <= 0)
        return {0, -deceleration_};
    return {speed, (speed_after(seconds + step) - speed) / step};
}

/// A cap without a time is one number, as ever; the rest is told apart by its kind.
void SpeedOrder::add_to(world::Hasher& hasher) const {
    hasher.add(kind_ == Kind::cap ? change_.to : -1.0);
    if (kind_ == Kind::none || (kind_ == Kind::cap && change_.duration <= 0))
        return;
    hasher.add(kind_);
    for (const double number : {change_.from, change_.to, change_.duration, deceleration_})
        hasher.add(number);
    hasher.add(change_.shape);
    hasher.add(has_begun_);
    hasher.add(start_);
}

}  // namespace reprise::drivers
