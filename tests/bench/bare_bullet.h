#pragma once

#include <memory>
#include <vector>

#include <BulletDynamics/Vehicle/btRaycastVehicle.h>
#include <btBulletDynamicsCommon.h>

#include "ground/mesh/ground.h"

namespace reprise::bench {

/// What Bullet costs by itself: the town's ground as a triangle mesh, one raycast vehicle, and a
/// number of kinematic boxes that move on a circle around it. Nothing of Reprise's in the loop.
class BareBullet {
  public:
    BareBullet(const ground::GroundMesh& ground, int boxes, const btVector3& place)
        : place_(place) {
        for (const Eigen::Vector3d& v : ground.vertices)
            vertices_.insert(vertices_.end(), {v.x(), v.y(), v.z()});
        for (const auto& triangle : ground.triangles)
            for (const std::uint32_t index : triangle)
                indices_.push_back(static_cast<int>(index));
        mesh_ =
            std::make_unique<btTriangleIndexVertexArray>(static_cast<int>(ground.triangles.size()),
                                                         indices_.data(),
                                                         static_cast<int>(3 * sizeof(int)),
                                                         static_cast<int>(ground.vertices.size()),
                                                         vertices_.data(),
                                                         static_cast<int>(3 * sizeof(btScalar)));
        ground_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.get(), true);
        world_.setGravity({0, 0, -9.81});
        add(0, *ground_, {0, 0, 0});
        chassis_ = add(1550, chassis_shape_, place + btVector3(0, 0, 0.6));
        for (int i = 0; i < boxes; ++i) {
            boxes_.push_back(add(0, box_shape_, place));
            boxes_.back()->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
            boxes_.back()->setActivationState(DISABLE_DEACTIVATION);
        }
        vehicle_ = std::make_unique<btRaycastVehicle>(tuning_, chassis_, &caster_);
        vehicle_->setCoordinateSystem(1, 2, 0);
        // Bullet's default suspension cannot carry a car: it would lie on its belly, and the
        // contacts would flatter us.
        tuning_.m_suspensionStiffness = 20;
        tuning_.m_suspensionCompression = 3;
        tuning_.m_suspensionDamping = 4;
        tuning_.m_maxSuspensionForce = 1e5;
        tuning_.m_frictionSlip = 1.05;
        world_.addVehicle(vehicle_.get());
        for (int i = 0; i < 4; ++i)
            vehicle_->addWheel({i < 2 ? 1.4 : -1.4, i % 2 == 0 ? 0.78 : -0.78, -0.2},
                               {0, 0, -1},
                               {0, 1, 0},
                               0.3,
                               0.32,
                               tuning_,
                               i < 2);
    }

    ~BareBullet() {
        world_.removeVehicle(vehicle_.get());
        for (const auto& body : bodies_)
            world_.removeRigidBody(body.get());
    }

    /// Ten substeps of 5 ms.
    void tick(int index) {
        for (int substep = 0; substep < 10; ++substep) {
            const double time = (index * 10 + substep) * 0.005;
            for (std::size_t i = 0; i < boxes_.size(); ++i) {
                const double angle = time * 0.2 + static_cast<double>(i) * 0.7;
                const double radius = 12 + 3.5 * static_cast<double>(i % 12);
                btTransform pose = btTransform::getIdentity();
                pose.setOrigin(place_ + btVector3(radius * btCos(angle), radius * btSin(angle), 1));
                boxes_[i]->setWorldTransform(pose);
                boxes_[i]->setInterpolationWorldTransform(pose);
            }
            world_.stepSimulation(0.005, 0);
        }
    }

  private:
    btRigidBody* add(double mass, btCollisionShape& shape, const btVector3& place) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0)
            shape.calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
        info.m_startWorldTransform.setOrigin(place);
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
        return bodies_.back().get();
    }

    btVector3 place_;
    std::vector<btScalar> vertices_;
    std::vector<int> indices_;
    std::unique_ptr<btTriangleIndexVertexArray> mesh_;
    std::unique_ptr<btBvhTriangleMeshShape> ground_;
    btBoxShape chassis_shape_{{2.3, 0.9, 0.5}};
    btBoxShape box_shape_{{2.3, 0.9, 0.7}};
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    btRigidBody* chassis_ = nullptr;
    std::vector<btRigidBody*> boxes_;
    btRaycastVehicle::btVehicleTuning tuning_;
    btDefaultVehicleRaycaster caster_{&world_};
    std::unique_ptr<btRaycastVehicle> vehicle_;
};

}  // namespace reprise::bench
