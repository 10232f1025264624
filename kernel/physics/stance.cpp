#include "kernel/physics/stance.h"

#include <array>
#include <cmath>

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/ground.h"

namespace reprise::kernel {

namespace {

/// Of the ground below or just above a place, or its own where there is none. [m]
double ground_height(const Ground& ground, double x, double y, double z) {
    struct Reach {
        double up, down;
    };

    for (const Reach reach : std::array{Reach{1.5, 5}, Reach{1.5, 200}, Reach{500, 500}}) {
        const btVector3 from(x, y, z + reach.up);
        const btVector3 to(x, y, z - reach.down);
        Ground::Hit hit{};
        if (ground.cast(from, to, hit))
            return from.z() + hit.fraction * (to.z() - from.z());
    }
    return z;
}

}  // namespace

Eigen::Isometry3d stance(const Ground& ground,
                         const world::VehicleModel& model,
                         const Eigen::Vector3d& p_world,
                         double yaw) {
    const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw));
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    std::array<double, 4> heights{};  // front left, front right, rear left, rear right
    for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d wheel = p_world.head<2>() + ahead * (i < 2 ? model.wheelbase : 0) +
                                      left * ((i % 2 == 0 ? 0.5 : -0.5) * model.track);
        heights[i] = ground_height(ground, wheel.x(), wheel.y(), p_world.z());
    }
    const double front = (heights[0] + heights[1]) / 2;
    const double rear = (heights[2] + heights[3]) / 2;
    const double climb = (front - rear) / model.wheelbase;
    const double bank = (heights[0] + heights[2] - heights[1] - heights[3]) / (2 * model.track);
    const Eigen::Vector3d x = Eigen::Vector3d(ahead.x(), ahead.y(), climb).normalized();
    const Eigen::Vector3d z = x.cross(Eigen::Vector3d(left.x(), left.y(), bank)).normalized();
    Eigen::Isometry3d pose_world_vehicle = Eigen::Isometry3d::Identity();
    pose_world_vehicle.linear().col(0) = x;
    pose_world_vehicle.linear().col(1) = z.cross(x);
    pose_world_vehicle.linear().col(2) = z;
    pose_world_vehicle.translation() = Eigen::Vector3d(p_world.x(), p_world.y(), rear);
    return pose_world_vehicle;
}

}  // namespace reprise::kernel
