#include "world/frames.h"

#include <cmath>
#include <numbers>

namespace reprise::world {

Eigen::Isometry3d pose(const Vec3& position, double yaw, double pitch) {
    Eigen::Isometry3d pose_world_body = Eigen::Isometry3d::Identity();
    pose_world_body.translation() = to_eigen(position);
    // Nose up is a negative turn about y (left).
    pose_world_body.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
    return pose_world_body;
}

double wrap_angle(double angle) {
    const double turn = 2.0 * std::numbers::pi;
    double wrapped = std::fmod(angle, turn);
    if (wrapped > std::numbers::pi)
        wrapped -= turn;
    if (wrapped <= -std::numbers::pi)
        wrapped += turn;
    return wrapped;
}

}  // namespace reprise::world
