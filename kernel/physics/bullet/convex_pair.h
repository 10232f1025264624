#pragma once

#include "kernel/physics/bullet/bullet.h"

namespace reprise::kernel {

/// Bullet's algorithm for two convex shapes, with its contacts bit for bit, at half the
/// price.
///
/// MUST    add the contact points that btConvexConvexAlgorithm adds.
/// ASSUMES one point a pair and substep, as Bullet is configured here: no perturbation, no clipping
///         of polyhedra. The cores are the shapes less their margins, here 4 cm each.
/// GOES    a box whose face tells it apart from the other shape has no contact. Else GJK, Bullet's
///         own, finds the distance of the cores. Bullet runs another GJK before that, to find
///         whether the cores meet, and looks afterwards along both normals for a better one: where
///         the cores lie apart, neither changes anything, and both are left out. Where they do not,
///         deep in each other, Bullet does it all.
/// KEEPS   the manifold, as Bullet's does.
class ConvexPair : public btActivatingCollisionAlgorithm {
  public:
    /// Makes it Bullet's choice for two types of shapes.
    class Maker : public btCollisionAlgorithmCreateFunc {
      public:
        btCollisionAlgorithm* CreateCollisionAlgorithm(
            btCollisionAlgorithmConstructionInfo& info,
            const btCollisionObjectWrapper* first,
            const btCollisionObjectWrapper* second) override;

      private:
        btGjkEpaPenetrationDepthSolver depths_;
    };

    ConvexPair(const btCollisionAlgorithmConstructionInfo& info,
               const btCollisionObjectWrapper* first,
               const btCollisionObjectWrapper* second,
               btConvexPenetrationDepthSolver& depths);
    ~ConvexPair() override;
    ConvexPair(const ConvexPair&) = delete;
    ConvexPair& operator=(const ConvexPair&) = delete;

    void processCollision(const btCollisionObjectWrapper* first,
                          const btCollisionObjectWrapper* second,
                          const btDispatcherInfo& info,
                          btManifoldResult* result) override;

    /// Never asked for: continuous collision detection is off.
    btScalar calculateTimeOfImpact(btCollisionObject* first,
                                   btCollisionObject* second,
                                   const btDispatcherInfo& info,
                                   btManifoldResult* result) override;

    void getAllContactManifolds(btManifoldArray& manifolds) override;

  private:
    btConvexPenetrationDepthSolver* depths_;
    btPersistentManifold* manifold_;
    bool owns_manifold_ = false;
};

}  // namespace reprise::kernel
