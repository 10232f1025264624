#include "kernel/physics/bullet/convex_pair.h"

#include <new>

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btComputeGjkEpaPenetration.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace reprise::kernel {

namespace {

constexpr double slack = 1e-3;  ///< [m] more than is lost to rounding
constexpr double apart = 1e-3;  ///< [m] cores at this distance do not meet
/// As btGjkPairDetector's with doubles: GJK ends when it comes closer by a smaller share.
constexpr double relative_error = 1e-12;

/// A shape and where it is, as Bullet's GJK for any two shapes asks for them.
class Placed {
  public:
    Placed(const btConvexShape& shape, const btTransform& pose)
        : shape_(shape),
          type_(shape.getShapeType()),
          margin_(shape.getMargin()),
          pose_(pose) {}

    const btConvexShape& shape() const { return shape_; }

    btTransform& pose() { return pose_; }

    const btTransform& getWorldTransform() const { return pose_; }

    btScalar getMargin() const { return margin_; }

    /// btConvexShape::localGetSupportVertexWithoutMarginNonVirtual; the two commonest in place.
    btVector3 getLocalSupportWithoutMargin(const btVector3& direction) const {
        if (type_ == BOX_SHAPE_PROXYTYPE) {
            const btVector3& half =
                static_cast<const btBoxShape&>(shape_).getImplicitShapeDimensions();
            return {btFsels(direction.x(), half.x(), -half.x()),
                    btFsels(direction.y(), half.y(), -half.y()),
                    btFsels(direction.z(), half.z(), -half.z())};
        }
        if (type_ == TRIANGLE_SHAPE_PROXYTYPE) {
            const btVector3* corners = static_cast<const btTriangleShape&>(shape_).m_vertices1;
            return corners[direction.dot3(corners[0], corners[1], corners[2]).maxAxis()];
        }
        return shape_.localGetSupportVertexWithoutMarginNonVirtual(direction);
    }

  private:
    const btConvexShape& shape_;
    int type_;
    btScalar margin_;
    btTransform pose_;
};

/// btComputeGjkEpaPenetration's answer.
struct Found {
    btScalar m_distance = 0;
    btVector3 m_normalBtoA;
    btVector3 m_pointOnA;
    btVector3 m_pointOnB;
};

/// Called by btComputeGjkEpaPenetration instead of its own where cores may meet: no answer, as
/// these are handed to btGjkPairDetector.
bool btGjkEpaCalcPenDepth(  // NOLINT(readability-identifier-naming)
    const Placed&,
    const Placed&,
    const btGjkCollisionDescription&,
    btVector3&,
    btVector3&,
    btVector3&) {
    return false;
}

/// Is the box farther than `reach` from the other shape along `out`, a unit vector that points out
/// of the box?
bool is_beyond(const Placed& box, const Placed& other, const btVector3& out, btScalar reach) {
    const btVector3 in_box = out * box.getWorldTransform().getBasis();
    const btVector3 in_other = -out * other.getWorldTransform().getBasis();
    const btVector3 way =
        other.getWorldTransform().getOrigin() - box.getWorldTransform().getOrigin();
    return way.dot(out) - box.getLocalSupportWithoutMargin(in_box).dot(in_box) -
               other.getLocalSupportWithoutMargin(in_other).dot(in_other) >
           reach;
}

/// No: a face of the box, or the way from the box to the other's axis, tells them apart by more
/// than `reach`, measured between the cores.
bool may_touch(const Placed& box, const Placed& other, btScalar reach) {
    const btVector3& half =
        static_cast<const btBoxShape&>(box.shape()).getImplicitShapeDimensions();
    const btTransform& pose_world_box = box.getWorldTransform();
    // The point of the other's upright axis (what stands in a town has one) that is level with the
    // box.
    btVector3 axis_point = other.getWorldTransform().getOrigin();
    axis_point.setZ(pose_world_box.getOrigin().z());
    const btVector3 way = (axis_point - pose_world_box.getOrigin()) * pose_world_box.getBasis();
    btVector3 out;  // of the box, in its frame
    for (int axis = 0; axis < 3; ++axis) {
        out[axis] = way[axis] - btClamped(way[axis], -half[axis], half[axis]);
        btVector3 face(0, 0, 0);
        face[axis] = way[axis] < 0 ? -1 : 1;
        if (out[axis] != 0 && is_beyond(box, other, pose_world_box.getBasis() * face, reach))
            return false;
    }
    const btScalar squared_distance = out.length2();
    return squared_distance == 0 ||
           !is_beyond(
               box, other, pose_world_box.getBasis() * (out / btSqrt(squared_distance)), reach);
}

enum class Answer { contact, no_contact, unknown };

/// Distance of two shapes whose cores lie apart. `max_distance` is measured between the cores.
Answer measure_distance(Placed first, Placed second, btScalar max_distance, Found& found) {
    // As btGjkPairDetector does it: in a frame between the two.
    const btVector3 middle = (first.pose().getOrigin() + second.pose().getOrigin()) * btScalar(0.5);
    first.pose().getOrigin() -= middle;
    second.pose().getOrigin() -= middle;
    btGjkCollisionDescription description;
    description.m_maximumDistanceSquared = max_distance * max_distance;
    description.m_gjkRelError2 = relative_error;
    btVoronoiSimplexSolver simplex;
    constexpr int valid_but_far = -1;
    const int code = btComputeGjkEpaPenetration(first, second, description, simplex, &found);
    if (code == valid_but_far)
        return Answer::no_contact;
    if (code != 0 || found.m_distance + (first.getMargin() + second.getMargin()) < apart)
        return Answer::unknown;
    found.m_pointOnB += middle;
    return Answer::contact;
}

}  // namespace

btCollisionAlgorithm* ConvexPair::Maker::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info,
    const btCollisionObjectWrapper* first,
    const btCollisionObjectWrapper* second) {
    void* place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(ConvexPair));
    return new (place) ConvexPair(info, first, second, depths_);
}

ConvexPair::ConvexPair(const btCollisionAlgorithmConstructionInfo& info,
                       const btCollisionObjectWrapper* first,
                       const btCollisionObjectWrapper* second,
                       btConvexPenetrationDepthSolver& depths)
    : btActivatingCollisionAlgorithm(info, first, second),
      depths_(&depths),
      manifold_(info.m_manifold) {}

ConvexPair::~ConvexPair() {
    if (owns_manifold_)
        m_dispatcher->releaseManifold(manifold_);
}

void ConvexPair::processCollision(const btCollisionObjectWrapper* first,
                                  const btCollisionObjectWrapper* second,
                                  const btDispatcherInfo& info,
                                  btManifoldResult* result) {
    if (manifold_ == nullptr) {
        manifold_ =
            m_dispatcher->getNewManifold(first->getCollisionObject(), second->getCollisionObject());
        owns_manifold_ = true;
    }
    result->setPersistentManifold(manifold_);

    const auto& shape = static_cast<const btConvexShape&>(*first->getCollisionShape());
    const auto& other_shape = static_cast<const btConvexShape&>(*second->getCollisionShape());
    const Placed one(shape, first->getWorldTransform());
    const Placed other(other_shape, second->getWorldTransform());
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    const btScalar max_distance = shape.getMargin() + other_shape.getMargin() +
                                  manifold_->getContactBreakingThreshold() +
                                  result->m_closestPointDistanceThreshold;
    input.m_maximumDistanceSquared = max_distance * max_distance;

    Answer answer = Answer::no_contact;
    Found found;
    const auto is_box = [](const btConvexShape& which) {
        return which.getShapeType() == BOX_SHAPE_PROXYTYPE;
    };
    // Of the ground's triangles only those that may touch come here.
    const bool is_on_ground = other_shape.getShapeType() == TRIANGLE_SHAPE_PROXYTYPE ||
                              shape.getShapeType() == TRIANGLE_SHAPE_PROXYTYPE;
    const bool near = is_on_ground || (is_box(shape) ? may_touch(one, other, max_distance + slack)
                                                     : may_touch(other, one, max_distance + slack));
    if (near)
        answer = measure_distance(one, other, max_distance, found);
    if (answer == Answer::contact) {
        result->addContactPoint(found.m_normalBtoA, found.m_pointOnB, found.m_distance);
    } else if (answer == Answer::unknown) {
        input.m_transformA = one.getWorldTransform();
        input.m_transformB = other.getWorldTransform();
        btVoronoiSimplexSolver simplex;
        btGjkPairDetector detector(&shape, &other_shape, &simplex, depths_);
        detector.getClosestPoints(input, *result, info.m_debugDraw);
    }
    if (owns_manifold_)
        result->refreshContactPoints();
}

btScalar ConvexPair::calculateTimeOfImpact(btCollisionObject*,
                                           btCollisionObject*,
                                           const btDispatcherInfo&,
                                           btManifoldResult*) {
    return 1;
}

void ConvexPair::getAllContactManifolds(btManifoldArray& manifolds) {
    if (owns_manifold_)
        manifolds.push_back(manifold_);
}

}  // namespace reprise::kernel
