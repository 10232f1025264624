#pragma once

#include <Eigen/Geometry>

#include "world/common_generated.h"

namespace reprise::world {

/// The recorded structs and Eigen's types are the same numbers; these turn one into the other.
inline Eigen::Vector3d to_eigen(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

inline Vec3 to_vec3(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

inline Eigen::Quaterniond to_eigen(const Quat& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

inline Quat to_quat(const Eigen::Quaterniond& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

/// Takes a body's coordinates to the world's.
inline Eigen::Isometry3d pose(const Vec3& position, const Quat& orientation) {
    Eigen::Isometry3d pose_world_body = Eigen::Isometry3d::Identity();
    pose_world_body.linear() = to_eigen(orientation).toRotationMatrix();
    pose_world_body.translation() = to_eigen(position);
    return pose_world_body;
}

/// As above, from yaw (counter-clockwise from east) and pitch (nose up positive). [rad]
Eigen::Isometry3d pose(const Vec3& position, double yaw, double pitch);

/// Where a body looks, seen from above: a unit vector. East for one that stands on end.
inline Eigen::Vector2d level_direction(const Quat& orientation) {
    const Eigen::Vector3d ahead = to_eigen(orientation) * Eigen::Vector3d::UnitX();
    const double level = ahead.head<2>().norm();
    return level > 0.1 ? Eigen::Vector2d(ahead.head<2>() / level) : Eigen::Vector2d::UnitX();
}

/// The angle in (-pi, pi].
double wrap_angle(double angle);

}  // namespace reprise::world
