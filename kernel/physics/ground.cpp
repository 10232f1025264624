#include "kernel/physics/ground.h"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "world/check.h"

namespace reprise::kernel {

namespace {

class FirstTriangle : public btTriangleRaycastCallback {
  public:
    FirstTriangle(const btVector3& from, const btVector3& to)
        : btTriangleRaycastCallback(from, to) {}

    btScalar reportHit(const btVector3& normal, btScalar fraction, int, int triangle) override {
        if (fraction < best || (fraction == best && triangle < index)) {
            best = fraction;
            index = triangle;
            best_normal = normal;
        }
        // A hair behind the best hit, so that its equals are still reported.
        return best * (1 + 1e-12);
    }

    btScalar best = 2;
    int index = -1;
    btVector3 best_normal;
};

}  // namespace

Ground::Ground(const ground::GroundMesh& mesh) : surfaces_(&mesh.surfaces) {
    REPRISE_CHECK(!mesh.triangles.empty(), "the town has no ground");
    REPRISE_CHECK(mesh.surfaces.size() == mesh.triangles.size(),
                  std::to_string(mesh.surfaces.size()) + " surfaces");
    static_assert(sizeof(mesh.vertices[0]) == 3 * sizeof(double));
    btIndexedMesh indexed;
    indexed.m_numTriangles = static_cast<int>(mesh.triangles.size());
    indexed.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.triangles.data());
    indexed.m_triangleIndexStride = sizeof(mesh.triangles[0]);
    indexed.m_numVertices = static_cast<int>(mesh.vertices.size());
    indexed.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.vertices.data());
    indexed.m_vertexStride = sizeof(mesh.vertices[0]);
    indexed.m_vertexType = PHY_DOUBLE;
    arrays_.addIndexedMesh(indexed, PHY_INTEGER);
    shape_ = std::make_unique<GroundShape>(&arrays_, true);
    std::vector<RayGrid::Corners> corners;
    corners.reserve(mesh.triangles.size());
    btVector3 low = to_bullet(mesh.vertices.front());
    btVector3 high = low;
    for (const Eigen::Vector3d& v : mesh.vertices) {
        low.setMin(to_bullet(v));
        high.setMax(to_bullet(v));
    }
    for (const auto& t : mesh.triangles)
        corners.push_back({to_bullet(mesh.vertices[t[0]]),
                           to_bullet(mesh.vertices[t[1]]),
                           to_bullet(mesh.vertices[t[2]])});
    rays_ = std::make_unique<RayGrid>(*shape_->getOptimizedBvh(), std::move(corners));
    outskirts_ = std::make_unique<Outskirts>(low, high, *rays_);
    shape_->go_on_beyond(*outskirts_);
}

bool Ground::cast(const btVector3& from, const btVector3& to, Hit& hit) const {
    FirstTriangle first(from, to);
    rays_->cast(first, from, to);
    if (first.index < 0)
        return cast_at_outskirts(from, to, hit);
    hit.fraction = first.best;
    hit.normal = first.best_normal;
    hit.surface = (*surfaces_)[static_cast<std::size_t>(first.index)];
    return true;
}

bool Ground::cast_at_outskirts(const btVector3& from, const btVector3& to, Hit& hit) const {
    if (!outskirts_->hold(to))
        return false;
    const double z = outskirts_->height(to);
    if (from.z() <= z || to.z() > z)
        return false;
    hit = {(from.z() - z) / (from.z() - to.z()), btVector3(0, 0, 1), ground::Surface::terrain};
    return true;
}

GroundBody::GroundBody(const Ground& ground, btDynamicsWorld& world)
    : body_(0, nullptr, &ground.shape()),
      world_(&world) {
    body_.setFriction(0.6);
    body_.setRestitution(0);
    tag(body_, ground_body, 0);
    world.addRigidBody(&body_);
}

GroundBody::~GroundBody() {
    world_->removeRigidBody(&body_);
}

void* WheelRays::castRay(const btVector3& from,
                         const btVector3& to,
                         btVehicleRaycasterResult& result) {
    ground::Surface& surface = surfaces_[next_++ % surfaces_.size()];
    surface = ground::Surface::terrain;
    Ground::Hit hit;
    if (!ground_->cast(from, to, hit))
        return nullptr;
    surface = hit.surface;
    result.m_distFraction = hit.fraction;
    result.m_hitPointInWorld = from + (to - from) * hit.fraction;
    // A round wheel rolls over a kerb's edge; a ray that meets the upright face would be thrown
    // back by it. So faces steeper than 60 degrees count as steps: support against the ray. Not
    // for a car that lies on its side: its springs would push it along the ground for ever.
    constexpr double steep = 0.5;  // cosine
    const btVector3 against = (from - to).normalized();
    const btVector3 normal = hit.normal.normalized();
    const bool is_step = normal.z() < steep && against.z() > steep;
    result.m_hitNormalInWorld = is_step ? against : normal;
    return this;  // anything but null means "hit": btRaycastVehicle uses it as a fixed ground
}

}  // namespace reprise::kernel
