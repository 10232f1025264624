#include "tests/ground/mesh/mesh_checks.h"

#include <cstdint>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/support/places.h"
#include "tests/support/plumb_line.h"

namespace reprise::test {

using ground::GroundMesh;
using ground::Surface;
using world::LaneT;
using world::TownT;

void expect_road_under_every_wheel(const TownT& town) {
    const GroundMesh mesh = ground::build_ground(town);
    for_each_wheel(town, [&](const LaneT& lane, const Eigen::Vector3d& p) {
        const auto hit = plumb(mesh, p + Eigen::Vector3d(0, 0, 1));
        ASSERT_TRUE(hit) << lane.name << " at " << p.transpose();
        EXPECT_NEAR(hit->z, p.z(), 0.05) << lane.name << " at " << p.transpose();
        EXPECT_TRUE(hit->surface == Surface::road || hit->surface == Surface::crossing)
            << lane.name << " at " << p.transpose() << ": " << static_cast<int>(hit->surface);
    });
}

Eigen::Vector3d normal_of(const GroundMesh& mesh, std::size_t i) {
    const auto& [p, q, r] = mesh.triangles[i];
    return (mesh.vertices[q] - mesh.vertices[p]).cross(mesh.vertices[r] - mesh.vertices[p]);
}

void expect_well_formed(const GroundMesh& mesh) {
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_EQ(mesh.surfaces.size(), mesh.triangles.size());
    for (const Eigen::Vector3d& vertex : mesh.vertices)
        ASSERT_TRUE(vertex.allFinite());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::uint32_t vertex : mesh.triangles[i])
            ASSERT_LT(vertex, mesh.vertices.size());
        const Eigen::Vector3d normal = normal_of(mesh, i);
        EXPECT_GT(normal.norm() / 2, 1e-8) << "triangle " << i;
        if (mesh.surfaces[i] == Surface::kerb) {
            EXPECT_NEAR(normal.normalized().z(), 0, 1e-9) << "triangle " << i;
        } else if (mesh.surfaces[i] == Surface::deck) {
            EXPECT_LT(normal.normalized().z(), 0.01) << "triangle " << i;
        } else {
            EXPECT_GT(normal.z(), 0) << "triangle " << i;
        }
    }
}

Surface surface_at(const GroundMesh& mesh, double x, double y, double z) {
    const auto hit = plumb(mesh, {x, y, z + 1});
    return hit ? hit->surface : Surface::marking;
}

}  // namespace reprise::test
