#include "kernel/physics/bullet/bullet_check.h"

#include <cmath>
#include <cstring>

#include "kernel/physics/bullet/bullet.h"

namespace reprise::kernel {

namespace {

constexpr double step = 0.005;  // [s]

/// Where a body at rest in the origin points to after a step of this spin [rad/s], by the
/// exponential map that Bullet uses.
btMatrix3x3 turned(const btVector3& spin) {
    const double rate = std::sqrt(spin.length2());
    const btVector3 axis = spin * (std::sin(0.5 * rate * step) / rate);
    btQuaternion turn(axis.x(), axis.y(), axis.z(), std::cos(rate * step * 0.5));
    turn = turn * btQuaternion::getIdentity();
    turn.safeNormalize();
    return btMatrix3x3(turn);
}

bool same_bits(const btMatrix3x3& a, const btMatrix3x3& b) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)  // one by one: Bullet's vectors have padding
            if (std::memcmp(&a[row][column], &b[row][column], sizeof(btScalar)) != 0)
                return false;
    return true;
}

}  // namespace

bool bullet_uses_our_maths() {
    btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, nullptr));
    // One sine in some twenty differs between musl and glibc: 64 turns tell them apart.
    for (int i = 1; i <= 64; ++i) {
        const btVector3 spin(1.37 * i, -0.11 * i, 0.023 * i);
        body.setAngularVelocity(spin);
        btTransform pose;
        body.predictIntegratedTransform(step, pose);
        if (!same_bits(pose.getBasis(), turned(spin)))
            return false;
    }
    return true;
}

}  // namespace reprise::kernel
