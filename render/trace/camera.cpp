#include "render/trace/camera.h"

#include <cmath>

#include "world/external/sensor_attributes.h"

namespace reprise::render {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// What a camera was told, or `usual` where that is below 0 or nothing.
double told(const world::SensorSpec& spec, const char* name, double least, double usual) {
    if (!world::is_camera(spec.kind))
        return usual;
    const double value = world::attribute(spec, name);
    return value > least ? value : usual;
}

/// [px] by the field of view from edge to edge; a pinhole's before its lens distorts it.
double focal_of(const world::SensorSpec& spec, const Lens& lens) {
    const double half = spec.width / 2.0;
    return lens.is_fisheye() ? half / lens.radius(spec.fov / 2) : half / std::tan(spec.fov / 2);
}

}  // namespace

Camera::Camera(const world::SensorSpec& spec, const Eigen::Isometry3d& pose_scene_mount)
    : width_(spec.width),
      height_(spec.height),
      lens_(spec) {
    focal_ = told(spec, "fx", 0, focal_of(spec, lens_));
    focal_y_ = told(spec, "fy", 0, focal_);
    middle_ = {told(spec, "cx", -1, width_ / 2.0), told(spec, "cy", -1, height_ / 2.0)};
    plain_ = lens_.is_plain();
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
    lay_out();
}

void Camera::lay_out() {
    right_ = rotation_scene_camera_.col(0) / focal_;
    down_ = rotation_scene_camera_.col(1) / focal_y_;
    corner_ = rotation_scene_camera_.col(2) - right_ * middle_.x() - down_ * middle_.y();
}

Vector3d Camera::bent_ray(double x, double y) const {
    const auto way =
        lens_.is_plain()
            ? std::optional(Vector3d((x - middle_.x()) / focal_, (y - middle_.y()) / focal_y_, 1))
            : lens_.direction({(x - middle_.x()) / focal_, (y - middle_.y()) / focal_y_});
    if (!way)
        return Vector3d::Zero();
    const Vector3d straight = rotation_scene_camera_ * *way;
    if (sharp_ <= 0)
        return straight;
    const Vector3d shifted = straight - aside_ / sharp_;
    return lens_.is_fisheye() ? shifted.normalized() : shifted;
}

Vector3d Camera::project(const Vector3d& p_scene) const {
    const Vector3d p_camera = rotation_scene_camera_.transpose() * (p_scene - position_);
    if (lens_.is_plain())
        return {middle_.x() + focal_ * p_camera.x() / p_camera.z(),
                middle_.y() + focal_y_ * p_camera.y() / p_camera.z(),
                p_camera.z()};
    const Vector2d place = lens_.place(p_camera);
    return {middle_.x() + focal_ * place.x(),
            middle_.y() + focal_y_ * place.y(),
            lens_.is_fisheye() ? p_camera.norm() : p_camera.z()};
}

Camera Camera::towards(const Camera& other, double share) const {
    Camera between = *this;
    between.position_ += share * (other.position_ - position_);
    between.rotation_scene_camera_ =
        Eigen::Quaterniond(rotation_scene_camera_)
            .slerp(share, Eigen::Quaterniond(other.rotation_scene_camera_))
            .toRotationMatrix();
    between.lay_out();
    return between;
}

Camera Camera::cropped(int first_row, int rows) const {
    Camera part = *this;
    part.height_ = rows;
    part.middle_.y() -= first_row;
    part.lay_out();
    return part;
}

Camera Camera::through(const Vector2d& aside, double sharp) const {
    Camera other = *this;
    other.plain_ = false;
    other.sharp_ = sharp;
    other.aside_ = rotation_scene_camera_.leftCols<2>() * aside;
    other.position_ += other.aside_;
    return other;
}

bool operator==(const Camera& left, const Camera& right) {
    return left.width_ == right.width_ && left.height_ == right.height_ &&
           left.focal_ == right.focal_ && left.focal_y_ == right.focal_y_ &&
           left.middle_ == right.middle_ && left.lens_ == right.lens_ &&
           left.position_ == right.position_ &&
           left.rotation_scene_camera_ == right.rotation_scene_camera_;
}

}  // namespace reprise::render
