#include "wheel/hands.h"

#include <algorithm>
#include <cmath>

namespace reprise::wheel {

namespace {

// Shares of the whole way a second, by feel.
constexpr double wheel_out = 1.6;
constexpr double wheel_back = 3.0;
constexpr double pedal_down = 2.5;
constexpr double pedal_up = 5.0;
constexpr double nearly_standing = 1.0;  // [m/s]
constexpr double most_sideways = 5.0;    // [m/s^2] that a key asks for; dry asphalt gives 8 or 9

double towards(double value, double target, double most) {
    return value + std::clamp(target - value, -most, most);
}

double pressed(double pedal, bool down, double step) {
    return towards(pedal, down ? 1 : 0, (down ? pedal_down : pedal_up) * step);
}

}  // namespace

/// Share of the largest steering angle: v^2 tan(angle) / wheelbase is the sideways acceleration of
/// a vehicle that rolls without slip.
double Hands::steering_limit(double speed) const {
    const double angle =
        std::atan2(most_sideways * model_->wheelbase, std::max(speed * speed, 1e-6));
    return std::min(angle / model_->max_steering_angle, 1.0);
}

remote::Client::Wheel Hands::advance(const Wishes& wishes, double speed, double step) {
    if (wishes.gear % 2 == 1 && std::abs(speed) < nearly_standing)
        reverse_ = !reverse_;
    const double side = (wishes.left ? 1 : 0) - (wishes.right ? 1 : 0);
    const double target = side * steering_limit(speed);
    const bool comes_back = std::abs(target) < std::abs(steer_) || target * steer_ < 0;
    steer_ = towards(steer_, target, (comes_back ? wheel_back : wheel_out) * step);
    throttle_ = pressed(throttle_, wishes.ahead && !wishes.back, step);
    brake_ = pressed(brake_, wishes.back, step);
    remote::Client::Wheel wheel;
    wheel.throttle = std::clamp(std::max(throttle_, wishes.throttle), 0.0, 1.0);
    wheel.brake = std::clamp(std::max(brake_, wishes.brake), 0.0, 1.0);
    wheel.steer = std::clamp(steer_ + wishes.steer, -1.0, 1.0);
    wheel.hand_brake = wishes.hand_brake;
    wheel.reverse = reverse_;
    return wheel;
}

}  // namespace reprise::wheel
