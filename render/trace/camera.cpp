#include "render/trace/camera.h"

#include <cmath>

namespace reprise::render {

Camera::Camera(const world::SensorSpec& spec, const Eigen::Isometry3d& pose_scene_mount)
    : width_(spec.width),
      height_(spec.height),
      focal_(spec.width / 2.0 / std::tan(spec.fov / 2)) {
    Eigen::Isometry3d pose_mount_body = Eigen::Isometry3d::Identity();
    pose_mount_body.translation() = spec.position;
    // Nose up is a negative turn about y (left).
    pose_mount_body.linear() = (Eigen::AngleAxisd(spec.yaw, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(-spec.pitch, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(spec.roll, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
    Eigen::Matrix3d rotation_body_camera;  // columns: where the optical x, y and z axes point
    rotation_body_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const Eigen::Isometry3d pose_scene_body = pose_scene_mount * pose_mount_body;
    position_ = pose_scene_body.translation();
    rotation_scene_camera_ = pose_scene_body.linear() * rotation_body_camera;
    right_ = rotation_scene_camera_.col(0) / focal_;
    down_ = rotation_scene_camera_.col(1) / focal_;
    corner_ = rotation_scene_camera_.col(2) - right_ * (width_ / 2.0) - down_ * (height_ / 2.0);
}

Eigen::Vector3d Camera::project(const Eigen::Vector3d& p_scene) const {
    const Eigen::Vector3d p_camera = rotation_scene_camera_.transpose() * (p_scene - position_);
    return {width_ / 2.0 + focal_ * p_camera.x() / p_camera.z(),
            height_ / 2.0 + focal_ * p_camera.y() / p_camera.z(),
            p_camera.z()};
}

bool operator==(const Camera& left, const Camera& right) {
    return left.width_ == right.width_ && left.height_ == right.height_ &&
           left.focal_ == right.focal_ && left.position_ == right.position_ &&
           left.rotation_scene_camera_ == right.rotation_scene_camera_;
}

}  // namespace reprise::render
