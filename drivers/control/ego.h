#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/tick.h"

namespace reprise::drivers {

/// The driver's own car as the last tick shows it, and where it is on the driver's path.
struct Ego {
    std::uint32_t id = 0;
    const world::VehicleModel* model = nullptr;
    Eigen::Vector3d position;   ///< world, on the ground below the rear axle
    Eigen::Vector2d direction;  ///< unit, of the car's x axis in plan
    double yaw = 0;
    double yaw_rate = 0;
    double speed = 0;  ///< [m/s] along the car's x axis
    double steering_angle = 0;
    double rear_axle_s = 0;  ///< along the path

    /// The front bumper along the path.
    double front_s() const { return rear_axle_s + model->length - model->rear_overhang; }

    /// The rear bumper along the path.
    double rear_s() const { return rear_axle_s - model->rear_overhang; }
};

inline Ego ego_of(const world::VehicleState& state) {
    Ego ego;
    ego.id = state.id();
    ego.model = &world::vehicle_models()[state.model()];
    ego.position = world::to_eigen(state.position());
    const Eigen::Vector3d ahead = world::to_eigen(state.orientation()) * Eigen::Vector3d::UnitX();
    ego.direction = ahead.head<2>().normalized();
    ego.yaw = std::atan2(ahead.y(), ahead.x());
    ego.yaw_rate = state.angular_velocity().z();
    ego.speed = world::to_eigen(state.velocity()).dot(ahead);
    ego.steering_angle = state.steering_angle();
    return ego;
}

}  // namespace reprise::drivers
