#include "kernel/physics/ground_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

namespace reprise::kernel {

namespace {

constexpr double rounding = 1e-3;  ///< [m] more than is lost to it

class OnlyNear : public btTriangleCallback {
  public:
    OnlyNear(const GroundShape::Box& box, btTriangleCallback& inner) : box_(box), inner_(inner) {}

    void processTriangle(btVector3* corners, int part, int index) override {
        if (box_.may_touch(corners))
            inner_.processTriangle(corners, part, index);
    }

  private:
    const GroundShape::Box& box_;
    btTriangleCallback& inner_;
};

}  // namespace

bool GroundShape::Box::may_touch(const btVector3* corners) const {
    const btVector3 p = pose_box_ground * corners[0];
    const btVector3 q = pose_box_ground * corners[1];
    const btVector3 r = pose_box_ground * corners[2];
    for (int axis = 0; axis < 3; ++axis)
        if (std::min({p[axis], q[axis], r[axis]}) > half[axis] + reach ||
            std::max({p[axis], q[axis], r[axis]}) < -half[axis] - reach)
            return false;
    const std::array<btVector3, 3> edges = {q - p, r - q, p - r};
    const btVector3 normal = edges[0].cross(edges[1]);
    const btScalar box_along_normal = half.dot(normal.absolute());
    if (std::abs(normal.dot(p)) > box_along_normal + reach * normal.length())
        return false;
    const std::array<btVector3, 3> corners_of_edges = {r, p, q};  // the one that an edge leaves out
    const std::array<btVector3, 3> starts = {p, q, r};
    for (std::size_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            btVector3 along(0, 0, 0);
            along[axis] = 1;
            const btVector3 across = along.cross(edges[i]);
            const btScalar one = across.dot(starts[i]);
            const btScalar other = across.dot(corners_of_edges[i]);
            const btScalar box = half.dot(across.absolute()) + reach * across.length();
            if (std::min(one, other) > box || std::max(one, other) < -box)
                return false;
        }
    return true;
}

void GroundShape::getAabb(const btTransform& pose, btVector3& low, btVector3& high) const {
    btBvhTriangleMeshShape::getAabb(pose, low, high);
    if (outskirts_ == nullptr)
        return;
    const btVector3 reach(Outskirts::reach, Outskirts::reach, 0);
    low -= reach;
    high += reach;
}

void GroundShape::processAllTriangles(btTriangleCallback* callback,
                                      const btVector3& low,
                                      const btVector3& high) const {
    if (box_ == nullptr)
        return btBvhTriangleMeshShape::processAllTriangles(callback, low, high);
    OnlyNear near(*box_, *callback);
    btBvhTriangleMeshShape::processAllTriangles(&near, low, high);
    if (outskirts_ != nullptr)
        outskirts_->offer(near, low, high);
}

btCollisionAlgorithm* BoxOnGround::Maker::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info,
    const btCollisionObjectWrapper* first,
    const btCollisionObjectWrapper* second) {
    void* place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(BoxOnGround));
    return new (place) BoxOnGround(info, first, second, m_swapped);
}

void BoxOnGround::processCollision(const btCollisionObjectWrapper* first,
                                   const btCollisionObjectWrapper* second,
                                   const btDispatcherInfo& info,
                                   btManifoldResult* result) {
    const btCollisionObjectWrapper& solid = ground_first_ ? *second : *first;
    const btCollisionObjectWrapper& mesh = ground_first_ ? *first : *second;
    const auto& shape = static_cast<const btBoxShape&>(*solid.getCollisionShape());
    // The world's only mesh, and made as one that can be looked at differently.
    auto& ground =
        const_cast<GroundShape&>(static_cast<const GroundShape&>(*mesh.getCollisionShape()));
    // Bullet adds a contact of which both margins and the threshold of the whole body's shape, or
    // less, fill the gap.
    const btScalar threshold =
        solid.getCollisionObject()->getCollisionShape()->getContactBreakingThreshold(
            gContactBreakingThreshold);
    const GroundShape::Box box{solid.getWorldTransform().inverse() * mesh.getWorldTransform(),
                               shape.getHalfExtentsWithoutMargin(),
                               shape.getMargin() + ground.getMargin() + threshold + rounding};
    ground.look_at(&box);
    btConvexConcaveCollisionAlgorithm::processCollision(first, second, info, result);
    ground.look_at(nullptr);
}

}  // namespace reprise::kernel
