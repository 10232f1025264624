#include "ground/mesh/ground_probe.h"

#include <gtest/gtest.h>

#include "world/random.h"

namespace reprise::ground {

namespace {

/// A level field of so many cells of a metre, two triangles each, from this corner.
GroundMesh field(const Eigen::Vector3d& corner, std::uint32_t cells) {
    GroundMesh mesh;
    for (std::uint32_t row = 0; row <= cells; ++row)
        for (std::uint32_t column = 0; column <= cells; ++column)
            mesh.vertices.emplace_back(corner + Eigen::Vector3d(column, row, 0));
    const std::uint32_t along = cells + 1;
    for (std::uint32_t row = 0; row < cells; ++row)
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t at = row * along + column;
            mesh.triangles.push_back({at, at + 1, at + along + 1});
            mesh.triangles.push_back({at, at + along + 1, at + along});
        }
    mesh.surfaces.assign(mesh.triangles.size(), Surface::terrain);
    return mesh;
}

}  // namespace

TEST(GroundProbe, FindsTheGroundOfAMapInTheCoordinatesOfAWholeCountry) {
    constexpr std::uint32_t cells = 12;
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0.3, 0.7, 0),
                                          Eigen::Vector3d(211755.58, 451621.51, 370),
                                          Eigen::Vector3d(-3512345.67, 5712345.89, 12)}) {
        const GroundMesh mesh = field(corner, cells);
        const GroundProbe probe(mesh);
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            const auto drawn = [&](std::uint64_t axis) {
                return cells * world::draw(1, i, world::Purpose::place, axis);
            };
            const Eigen::Vector3d place = corner + Eigen::Vector3d(drawn(0), drawn(1), 1);
            const auto hit = probe.nearest(place);
            ASSERT_TRUE(hit) << place.transpose() - corner.transpose();
            ASSERT_NEAR(hit->z, corner.z(), 1e-6);
        }
    }
}

}  // namespace reprise::ground
