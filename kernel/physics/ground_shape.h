#pragma once

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/outskirts.h"

namespace reprise::kernel {

/// The ground's mesh. While a box is looked at, it offers only triangles that the box can touch:
/// of the others, all within a tilted car's wide axis-parallel bounds, Bullet would find the
/// distance by GJK, twenty times as dear, and add no contact.
class GroundShape : public btBvhTriangleMeshShape {
  public:
    using btBvhTriangleMeshShape::btBvhTriangleMeshShape;

    /// A box without its collision margin, which Bullet rounds it with.
    struct Box {
        btTransform pose_box_ground;  ///< takes ground to box
        btVector3 half;
        btScalar reach;  ///< [m] at a larger distance from the box there is no contact

        /// No: an axis of the box, the triangle's normal, or what stands upright on an axis and an
        /// edge, tells them apart. In the ground's frame.
        bool may_touch(const btVector3* corners) const;
    };

    void look_at(const Box* box) { box_ = box; }

    /// What lies beyond its mesh, which must outlive it. Not before that has its bounds.
    void go_on_beyond(const Outskirts& outskirts) { outskirts_ = &outskirts; }

    void getAabb(const btTransform& pose, btVector3& low, btVector3& high) const override;

    void processAllTriangles(btTriangleCallback* callback,
                             const btVector3& low,
                             const btVector3& high) const override;

  private:
    const Box* box_ = nullptr;
    const Outskirts* outskirts_ = nullptr;
};

/// Bullet's own algorithm for a box on a mesh, which must be a GroundShape, with that look at it.
class BoxOnGround : public btConvexConcaveCollisionAlgorithm {
  public:
    /// Makes it Bullet's choice wherever a box meets a mesh.
    class Maker : public btCollisionAlgorithmCreateFunc {
      public:
        /// `ground_first`: the mesh is the first of the two.
        explicit Maker(bool ground_first) { m_swapped = ground_first; }

        btCollisionAlgorithm* CreateCollisionAlgorithm(
            btCollisionAlgorithmConstructionInfo& info,
            const btCollisionObjectWrapper* first,
            const btCollisionObjectWrapper* second) override;
    };

    BoxOnGround(const btCollisionAlgorithmConstructionInfo& info,
                const btCollisionObjectWrapper* first,
                const btCollisionObjectWrapper* second,
                bool ground_first)
        : btConvexConcaveCollisionAlgorithm(info, first, second, ground_first),
          ground_first_(ground_first) {}

    void processCollision(const btCollisionObjectWrapper* first,
                          const btCollisionObjectWrapper* second,
                          const btDispatcherInfo& info,
                          btManifoldResult* result) override;

  private:
    bool ground_first_;
};

}  // namespace reprise::kernel
