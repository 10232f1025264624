#include "drivers/control/pid_driver.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"

namespace reprise::drivers {

namespace {

constexpr double most_throttle = 0.75;
constexpr double most_brake = 0.5;      // with CARLA's 0.3 it would not stop for a child
constexpr double most_steering = 0.8;   // share of the lock
constexpr double nearest_waypoint = 3;  // [m] ahead of the front axle
constexpr double waypoint_time = 0.5;   // [s]
constexpr double stops_below = -0.6;    // [m/s^2] allowed
constexpr double goes_above = 0.4;      // [m/s^2] allowed
constexpr double kmh = 3.6;             // the speed's gains are for km/h

}  // namespace

double Pid::answer(double error, double step) {
    const double before = count_ == 0 ? error : errors_[(count_ - 1) % errors_.size()];
    errors_[count_++ % errors_.size()] = error;
    double sum = 0;
    for (const double one : errors_)
        sum += one;
    return gains_.proportional * error + gains_.integral * sum * step +
           gains_.differential * (error - before) / step;
}

void Pid::add_to(world::Hasher& hasher) const {
    for (const double error : errors_)
        hasher.add(error);
    hasher.add(std::uint64_t{count_});
}

PidDriver::Answer PidDriver::drive(
    const Ego& ego, const Path& path, double allowed, double most, double share, double step) {
    stops_ = stops_ ? allowed < goes_above * share : allowed < stops_below * share;
    const double target = stops_ ? 0 : std::min(cruise * std::sqrt(share), most);
    const double answer = speed_.answer(kmh * (target - ego.speed), step);
    Answer said;
    if (answer >= 0 && target > 0)
        said.pedals.throttle = std::min(answer, most_throttle);
    else
        said.pedals.brake = std::min(std::abs(answer), most_brake);
    if (stops_ && ego.speed < 0.3)
        said.pedals = {0, most_brake};

    const double ahead = nearest_waypoint + waypoint_time * std::max(ego.speed, 0.0);
    const Eigen::Vector2d waypoint =
        path.at(ego.rear_axle_s + ego.model->wheelbase + ahead).position.head<2>();
    const Eigen::Vector2d to = waypoint - ego.position.head<2>();
    const double direction = world::wrap_angle(std::atan2(to.y(), to.x()) - ego.yaw);
    said.steer = std::clamp(steering_.answer(direction, step), -most_steering, most_steering);
    return said;
}

void PidDriver::add_to(world::Hasher& hasher) const {
    speed_.add_to(hasher);
    steering_.add_to(hasher);
    hasher.add(stops_);
}

}  // namespace reprise::drivers
