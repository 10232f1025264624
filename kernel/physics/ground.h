#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ground/mesh/ground.h"
#include "kernel/physics/bullet.h"
#include "kernel/physics/ground_shape.h"
#include "kernel/physics/outskirts.h"
#include "kernel/physics/ray_grid.h"

namespace reprise::kernel {

/// The static ground in Bullet: one triangle mesh with a bounding volume hierarchy, and outskirts.
class Ground {
  public:
    /// Copies the mesh and adds one body to `world`, which must outlive this.
    Ground(const ground::GroundMesh& mesh, btDynamicsWorld& world);
    ~Ground();
    Ground(const Ground&) = delete;
    Ground& operator=(const Ground&) = delete;

    struct Hit {
        double fraction;   ///< of the way from -> to
        btVector3 normal;  ///< of the triangle, towards `from`
        ground::Surface surface;
    };

    /// The first triangle on the way. Ties go to the lower triangle index, so that the answer does
    /// not depend on how the hierarchy is walked. Where there is none, the outskirts. Returns false
    /// when the ray meets nothing.
    bool cast(const btVector3& from, const btVector3& to, Hit& hit) const;

  private:
    bool cast_at_outskirts(const btVector3& from, const btVector3& to, Hit& hit) const;

    std::vector<std::array<double, 3>> vertices_;
    std::vector<std::array<int, 3>> triangles_;
    std::vector<ground::Surface> surfaces_;
    btTriangleIndexVertexArray arrays_;
    std::unique_ptr<GroundShape> shape_;
    std::unique_ptr<RayGrid> rays_;
    std::unique_ptr<Outskirts> outskirts_;
    std::unique_ptr<btRigidBody> body_;
    btDynamicsWorld* world_;
};

/// The rays of one vehicle's wheels: they see the ground only, never other bodies. Remembers what
/// each of the four stands on.
class WheelRays : public btVehicleRaycaster {
  public:
    explicit WheelRays(const Ground& ground) : ground_(&ground) {}

    /// Before the four rays of a substep, which btRaycastVehicle casts in the order of the wheels.
    void begin() { next_ = 0; }

    ground::Surface surface(int wheel) const { return surfaces_[static_cast<std::size_t>(wheel)]; }

    void* castRay(const btVector3& from,
                  const btVector3& to,
                  btVehicleRaycasterResult& result) override;

  private:
    const Ground* ground_;
    std::array<ground::Surface, 4> surfaces_{};
    std::size_t next_ = 0;
};

}  // namespace reprise::kernel
