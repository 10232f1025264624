#include "kernel/nearest_ahead.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

/// How far a box, seen from the vehicle, reaches back into the straight corridor of this half
/// width: the least x of its corners. Nothing when it stands beside the corridor or behind.
std::optional<double> near_end(const Eigen::Isometry3d& pose_vehicle_box,
                               const world::VehicleModel& box,
                               double half_width) {
    double near = std::numeric_limits<double>::infinity();
    double rightmost = near;
    double leftmost = -near;
    for (const double x : {-box.rear_overhang, box.length - box.rear_overhang})
        for (const double y : {-box.width / 2, box.width / 2}) {
            const Eigen::Vector3d corner = pose_vehicle_box * Eigen::Vector3d(x, y, 0);
            near = std::min(near, corner.x());
            rightmost = std::min(rightmost, corner.y());
            leftmost = std::max(leftmost, corner.y());
        }
    const bool beside = rightmost > half_width || leftmost < -half_width;
    return beside || pose_vehicle_box.translation().x() < 0 ? std::nullopt : std::optional(near);
}

}  // namespace

Ahead nearest_ahead(const world::VehicleState& vehicle, const world::TickDraft& next) {
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    const Eigen::Isometry3d pose_world_vehicle =
        world::pose(vehicle.position(), vehicle.orientation());
    const double front = model.length - model.rear_overhang;
    const Eigen::Isometry3d pose_vehicle_world = pose_world_vehicle.inverse();
    Ahead ahead;
    const auto look_at = [&](const Eigen::Isometry3d& pose_world_other, const auto& other) {
        const auto near = near_end(pose_vehicle_world * pose_world_other,
                                   world::vehicle_models()[other.model()],
                                   model.width / 2);
        if (near && std::max(0.0, *near - front) < ahead.gap)
            ahead = {std::max(0.0, *near - front), other.id()};
    };
    const Eigen::Vector3d forward = pose_world_vehicle.linear().col(0);
    for (const world::CarState& car : next.traffic.cars) {
        const Eigen::Vector3d offset =
            world::to_eigen(car.position()) - pose_world_vehicle.translation();
        // Whose rear axle is behind ours is none of them; most are told without their pose.
        constexpr double rounding = 1e-6;  // [m]
        if (offset.dot(forward) > -rounding && offset.norm() < sensing_range + 20)
            look_at(world::pose(car.position(), double{car.yaw()}, double{car.pitch()}), car);
    }
    for (const world::VehicleState& other : next.tick.vehicles)
        if (other.id() != vehicle.id())
            look_at(world::pose(other.position(), other.orientation()), other);
    return ahead;
}

}  // namespace reprise::kernel
