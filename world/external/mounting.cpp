#include "world/external/mounting.h"

namespace reprise::world {

Eigen::Isometry3d pose_in_mount(const SensorSpec& spec) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = spec.position;
    pose.linear() = (Eigen::AngleAxisd(spec.yaw, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(-spec.pitch, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(spec.roll, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    return pose;
}

}  // namespace reprise::world
