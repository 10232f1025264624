#include "drivers/control/steering.h"

#include <algorithm>
#include <cmath>

#include "world/models/car_model.h"

namespace reprise::drivers {

namespace {

constexpr double tracked_share = 0.5;  // of the wheelbase, ahead of the rear axle
constexpr double offset_gain = 2.0;    // [1/s]
constexpr double told_heading_gain = 1.5;
constexpr double told_gain = 3.0;         // [1/s] of one who is told his place
constexpr double offset_softening = 1.5;  // [m/s]
constexpr double steepest_return = 0.5;   // [rad] towards the path
constexpr double preview = 0.08;          // [s] a tick's delay and the wheels' turning
constexpr double yaw_damping = 0.05;      // [s]

/// What the car should do there.
struct Aim {
    Eigen::Vector2d position;   ///< world, of the tracked point
    Eigen::Vector2d direction;  ///< unit, of the track there
    double yaw = 0;             ///< [rad] of the body
    double curvature = 0;       ///< [1/m] of the track
    double curvature_soon = 0;  ///< [1/m] when the wheels will have turned
    double gain = offset_gain;  ///< [1/s]
    double heading_gain = 1;
    double understeer = 0;  ///< [rad] that the wheels must be turned more
};

double steer_to(const Ego& ego, const Aim& aim, double ahead) {
    const double wheelbase = ego.model->wheelbase;
    const double speed = std::max(ego.speed, 0.0);
    const Eigen::Vector2d tracked = ego.position.head<2>() + ahead * ego.direction;
    const Eigen::Vector2d offset = tracked - aim.position;
    const double left = aim.direction.x() * offset.y() - aim.direction.y() * offset.x();
    const double heading = world::wrap_angle(aim.yaw - ego.yaw);

    const double turn = std::atan(wheelbase * aim.curvature_soon) + aim.understeer;
    const double back = std::clamp(
        std::atan2(-aim.gain * left, offset_softening + speed), -steepest_return, steepest_return);
    const double damping = yaw_damping * (speed * aim.curvature - ego.yaw_rate);
    const double angle = turn + aim.heading_gain * heading + back + damping;
    return std::clamp(angle / ego.model->max_steering_angle, -1.0, 1.0);
}

/// To the left of the path, and across it. Tyres slip: in a bend the body points into it, and the
/// wheels more so.
void move_beside(Aim& aim, const BesidePath& beside, double speed, double ahead) {
    const Eigen::Vector2d left(-aim.direction.y(), aim.direction.x());
    aim.position += beside.offset * left;
    aim.direction = (aim.direction + beside.slope * left).normalized();
    // On the inner side of a bend the line is bent more.
    constexpr double most_narrowing = 0.8;
    const double narrowing = std::min(aim.curvature * beside.offset, most_narrowing);
    aim.curvature = aim.curvature / (1 - narrowing) + beside.bend;
    aim.curvature_soon = aim.curvature_soon / (1 - narrowing) + beside.bend_soon;
    const double sideways = std::clamp(speed * speed * aim.curvature / world::gravity, -0.6, 0.6);
    const double sideways_soon =
        std::clamp(speed * speed * aim.curvature_soon / world::gravity, -0.6, 0.6);
    aim.yaw += std::atan(beside.slope) - std::asin(std::clamp(ahead * beside.bend, -0.9, 0.9)) +
               sideways / world::rear_cornering;
    aim.gain = told_gain;
    aim.heading_gain = told_heading_gain;
    aim.understeer = sideways_soon * (1 / world::front_cornering - 1 / world::rear_cornering);
}

}  // namespace

double tracked_ahead(const world::VehicleModel& model) {
    return tracked_share * model.wheelbase;
}

double steer(const Ego& ego, const Path& path, const std::optional<BesidePath>& beside) {
    const double ahead = tracked_ahead(*ego.model);
    const double s = ego.rear_axle_s + ahead;
    const PathPoint here = path.at(s);
    Aim aim{here.position.head<2>(), here.direction};
    aim.curvature_soon = path.curvature(s + preview * std::max(ego.speed, 0.0), 1.0);
    aim.curvature = path.curvature(s, 1.0);
    // In a steady turn the body points by asin(ahead * curvature) away from the track's tangent.
    const double slip = std::asin(std::clamp(ahead * aim.curvature, -0.9, 0.9));
    aim.yaw = here.yaw - slip;
    if (beside)
        move_beside(aim, *beside, ego.speed, ahead);
    return steer_to(ego, aim, ahead);
}

double steer(const Ego& ego,
             const WideTurnPlan& wide_turn,
             const std::optional<BesidePath>& beside) {
    const double ahead = tracked_ahead(*ego.model);
    const WideTurnPoint here = wide_turn.at(ego.rear_axle_s);
    const Eigen::Vector2d direction(std::cos(here.yaw), std::sin(here.yaw));
    const double soon = ego.rear_axle_s + preview * std::max(ego.speed, 0.0);
    Aim aim{here.position + ahead * direction,
            direction,
            here.yaw,
            here.curvature,
            wide_turn.at(soon).curvature};
    if (beside)
        move_beside(aim, *beside, ego.speed, ahead);
    return steer_to(ego, aim, ahead);
}

}  // namespace reprise::drivers
