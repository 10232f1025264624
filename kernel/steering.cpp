#include "kernel/steering.h"

#include <algorithm>
#include <cmath>

namespace reprise::kernel {

namespace {

constexpr double tracked_share = 0.5;     // of the wheelbase, ahead of the rear axle
constexpr double offset_gain = 2.0;       // [1/s]
constexpr double offset_softening = 1.5;  // [m/s]
constexpr double steepest_return = 0.5;   // [rad] towards the path
constexpr double preview = 0.08;          // [s] a tick's delay and the wheels' turning
constexpr double yaw_damping = 0.05;      // [s]

}  // namespace

double steer(const Ego& ego, const Path& path) {
    const double wheelbase = ego.model->wheelbase;
    const double ahead = tracked_share * wheelbase;
    const double speed = std::max(ego.speed, 0.0);
    const Eigen::Vector2d tracked = ego.position.head<2>() + ahead * ego.direction;
    const PathPoint here = path.at(ego.rear_axle_s + ahead);
    const Eigen::Vector2d offset = tracked - here.position.head<2>();
    const double left = here.direction.x() * offset.y() - here.direction.y() * offset.x();

    // In a steady turn the body points by asin(ahead * curvature) away from the track's tangent.
    const double bend = path.curvature(ego.rear_axle_s + ahead + preview * speed, 1.0);
    const double bend_here = path.curvature(ego.rear_axle_s + ahead, 1.0);
    const double slip = std::asin(std::clamp(ahead * bend_here, -0.9, 0.9));
    const double heading = world::wrap_angle(here.yaw - slip - ego.yaw);

    const double turn = std::atan(wheelbase * bend);
    const double back = std::clamp(std::atan2(-offset_gain * left, offset_softening + speed),
                                   -steepest_return,
                                   steepest_return);
    const double damping = yaw_damping * (speed * bend_here - ego.yaw_rate);
    const double angle = turn + heading + back + damping;
    return std::clamp(angle / ego.model->max_steering_angle, -1.0, 1.0);
}

}  // namespace reprise::kernel
