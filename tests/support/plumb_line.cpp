#include "tests/support/plumb_line.h"

#include <span>

#include "world/digest.h"

namespace reprise::test {

std::optional<Hit> plumb(const ground::GroundMesh& mesh, const Eigen::Vector3d& from) {
    std::optional<Hit> first;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Eigen::Vector3d& p = mesh.vertices[mesh.triangles[i][0]];
        const Eigen::Vector3d& q = mesh.vertices[mesh.triangles[i][1]];
        const Eigen::Vector3d& r = mesh.vertices[mesh.triangles[i][2]];
        const auto area = [&](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
            return (u.x() - from.x()) * (v.y() - from.y()) -
                   (v.x() - from.x()) * (u.y() - from.y());
        };
        const double over_p = area(q, r);
        const double over_q = area(r, p);
        const double over_r = area(p, q);
        const double whole = over_p + over_q + over_r;
        // Vertical faces have no area from above.
        if (over_p < 0 || over_q < 0 || over_r < 0 || whole < 1e-9)
            continue;
        const double z = (over_p * p.z() + over_q * q.z() + over_r * r.z()) / whole;
        if (z <= from.z() && (!first || z > first->z))
            first = Hit{z, mesh.surfaces[i]};
    }
    return first;
}

std::string bytes_of(const ground::GroundMesh& mesh) {
    world::Hasher hasher;
    for (const Eigen::Vector3d& vertex : mesh.vertices)
        hasher.add_bytes(vertex.data(), 3 * sizeof(double));
    hasher.add(std::span(mesh.triangles));
    hasher.add(std::span(mesh.surfaces));
    return world::to_hex(hasher.digest128());
}

}  // namespace reprise::test
