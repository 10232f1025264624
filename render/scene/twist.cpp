#include "render/scene/twist.h"

#include <cmath>

#include "world/frames.h"

namespace reprise::render {

using Eigen::Vector3d;
using world::to_eigen;

Eigen::Isometry3d Twist::back(double ago) const {
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    const double speed = turning.norm();
    if (speed * ago > 1e-12)
        moved.linear() = Eigen::AngleAxisd(-speed * ago, turning / speed).toRotationMatrix();
    moved.translation() = origin - velocity * ago - moved.linear() * origin;
    return moved;
}

std::optional<Twist> find_twist(const world::TickView& tick, std::uint32_t actor) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), actor))
        return Twist{to_eigen(vehicle->position()),
                     to_eigen(vehicle->velocity()),
                     to_eigen(vehicle->angular_velocity())};
    if (const world::CarState* car = world::find(tick.cars(), actor)) {
        const Eigen::Isometry3d pose = world::pose(
            car->position(), static_cast<double>(car->yaw()), static_cast<double>(car->pitch()));
        return Twist{pose.translation(),
                     pose.linear().col(0) * static_cast<double>(car->speed()),
                     Vector3d::Zero()};
    }
    if (const world::WalkerState* walker = world::find(tick.walkers(), actor)) {
        const auto yaw = static_cast<double>(walker->yaw());
        return Twist{
            to_eigen(walker->position()),
            static_cast<double>(walker->speed()) * Vector3d(std::cos(yaw), std::sin(yaw), 0),
            Vector3d::Zero()};
    }
    if (const world::PropState* prop = world::find(tick.props(), actor))
        return Twist{to_eigen(prop->position()),
                     to_eigen(prop->velocity()),
                     to_eigen(prop->angular_velocity())};
    return std::nullopt;
}

}  // namespace reprise::render
