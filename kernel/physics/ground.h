#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ground/mesh/ground.h"
#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/ground_shape.h"
#include "kernel/physics/outskirts.h"
#include "kernel/physics/ray_grid.h"

namespace reprise::kernel {

/// The static ground in Bullet: one triangle mesh with a bounding volume hierarchy, and outskirts.
/// Of no world: many may stand on it, one after the other.
class Ground {
  public:
    /// Looks at the mesh's triangles where they are: it must outlive this.
    explicit Ground(const ground::GroundMesh& mesh);
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

    /// For one body at a time.
    GroundShape& shape() const { return *shape_; }

  private:
    bool cast_at_outskirts(const btVector3& from, const btVector3& to, Hit& hit) const;

    const std::vector<ground::Surface>* surfaces_;
    btTriangleIndexVertexArray arrays_;
    std::unique_ptr<GroundShape> shape_;
    std::unique_ptr<RayGrid> rays_;
    std::unique_ptr<Outskirts> outskirts_;
};

/// The ground's body in a world. Both must outlive it.
class GroundBody {
  public:
    GroundBody(const Ground& ground, btDynamicsWorld& world);
    ~GroundBody();
    GroundBody(const GroundBody&) = delete;
    GroundBody& operator=(const GroundBody&) = delete;

  private:
    btRigidBody body_;
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
