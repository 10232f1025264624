#pragma once

// Private to the room: Bullet, and what turns its vectors into ours. Nothing that another room
// includes may include this.
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletDynamics/Vehicle/btRaycastVehicle.h>
#include <Eigen/Geometry>
#include <btBulletDynamicsCommon.h>

#include "world/common_generated.h"
#include "world/digest.h"

namespace reprise::kernel {

static_assert(sizeof(btScalar) == sizeof(double),
              "build with the flags of pkg-config bullet-float64");

/// What a Bullet body stands for (its user index); user index 2 is the actor's id.
enum BodyKind : int { ground_body, obstacle_body, car_body, vehicle_body, prop_body };

inline void tag(btCollisionObject& object, BodyKind kind, std::uint32_t actor) {
    object.setUserIndex(kind);
    object.setUserIndex2(static_cast<int>(actor));
}

inline std::uint32_t actor_of(const btCollisionObject& object) {
    return static_cast<std::uint32_t>(object.getUserIndex2());
}

/// [kg] What a body weighs that Bullet moves as if it had no mass: user index 3.
inline void tag_mass(btCollisionObject& object, double mass) {
    object.setUserIndex3(static_cast<int>(mass));
}

/// Infinite for what stands fast.
inline double mass_of(const btCollisionObject& object) {
    constexpr double infinite = 1e9;
    return object.getUserIndex3() > 0 ? object.getUserIndex3() : infinite;
}

inline btVector3 to_bullet(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

inline btVector3 to_bullet(const world::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

inline btQuaternion to_bullet(const Eigen::Quaterniond& q) {
    return {q.x(), q.y(), q.z(), q.w()};
}

inline btTransform to_bullet(const Eigen::Isometry3d& pose) {
    return btTransform(to_bullet(Eigen::Quaterniond(pose.linear())),
                       to_bullet(Eigen::Vector3d(pose.translation())));
}

inline world::Vec3 to_vec3(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}

inline world::Quat to_quat(const btQuaternion& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

/// Three numbers: btVector3 carries a fourth that means nothing.
inline void add_vector(world::Hasher& hasher, const btVector3& v) {
    hasher.add(to_vec3(v));
}

inline void add_transform(world::Hasher& hasher, const btTransform& transform) {
    for (int row = 0; row < 3; ++row)
        add_vector(hasher, transform.getBasis()[row]);
    add_vector(hasher, transform.getOrigin());
}

}  // namespace reprise::kernel
