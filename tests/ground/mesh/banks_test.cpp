// Earth from the edges of roads down to terrain that lies lower.
#include "ground/mesh/banks.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/ground/mesh/mesh_checks.h"
#include "tests/support/places.h"
#include "tests/support/plumb_line.h"
#include "tests/support/worlds.h"
#include "world/town.h"

namespace reprise {

namespace {

using ground::GroundMesh;
using ground::Surface;
using test::plumb;
using world::LaneKind;
using world::TownT;
using world::Vec3;

/// One road at z = 0, and another 1 m higher 6 m beside it: the terrain keeps below the lower one,
/// and of a cell of it that both touch the higher one's edge stands in the air.
TownT terraces() {
    TownT town;
    town.lanes.push_back(test::lane("low_0", LaneKind::driving, {Vec3(0, 0, 0), Vec3(80, 0, 0)}));
    town.lanes.push_back(test::lane("high_0", LaneKind::driving, {Vec3(0, 6, 1), Vec3(80, 6, 1)}));
    return town;
}

GroundMesh both(GroundMesh mesh, const GroundMesh& more) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& [p, q, r] : more.triangles)
        mesh.triangles.push_back({first + p, first + q, first + r});
    mesh.surfaces.insert(mesh.surfaces.end(), more.surfaces.begin(), more.surfaces.end());
    return mesh;
}

TEST(Banks, ReachFromTheEdgeOfARoadDownToTheTerrain) {
    const GroundMesh ground = ground::build_ground(terraces());
    const GroundMesh banks = ground::build_banks(ground);
    const GroundMesh seen = both(ground, banks);
    const double edge = 6 - 1.75 - 0.02;
    double hung = 0;  // [m], before
    for (double x = 1; x < 79; x += 0.37) {
        double last = 1;
        // 2 cm outside the edge and on: no step that one could look under.
        for (double y = edge - 0.02; y > 1.8; y -= 0.02) {
            const auto hit = plumb(seen, {x, y, 1.5});
            ASSERT_TRUE(hit) << x << ' ' << y;
            EXPECT_EQ(hit->surface, Surface::terrain) << x << ' ' << y;
            ASSERT_GT(hit->z, last - 0.1) << x << ' ' << y;
            last = hit->z;
        }
        // So gentle that a high sun shines on all of them.
        EXPECT_GT(plumb(seen, {x, edge - 0.3, 1.5})->z, 0.65) << x;
        hung = std::max(hung, 1 - plumb(ground, {x, edge - 0.02, 1.5})->z);
    }
    EXPECT_GT(hung, 0.3);
    for (const Surface surface : banks.surfaces)
        EXPECT_EQ(surface, Surface::terrain);
}

TEST(Banks, CoverNoRoad) {
    for (const TownT& town : {terraces(), test::bridge(), test::t_junction(0.1)}) {
        const GroundMesh ground = ground::build_ground(town);
        const GroundMesh seen = both(ground, ground::build_banks(ground));
        test::for_each_wheel(town, [&](const world::LaneT& lane, const Eigen::Vector3d& p) {
            const Eigen::Vector3d from = p + Eigen::Vector3d::UnitZ();
            EXPECT_EQ(plumb(seen, from)->z, plumb(ground, from)->z) << lane.name << ' ' << p.x();
        });
    }
}

TEST(Banks, AreNotWhereTheTownIsFlatOrABridgeHasASide) {
    for (const TownT& town : {test::straight_road(100), test::t_junction()})
        EXPECT_TRUE(ground::build_banks(ground::build_ground(town)).triangles.empty());
    // Over the lower road there is none, and below the bridge one looks through.
    const GroundMesh banks = ground::build_banks(ground::build_ground(test::bridge()));
    for (const Eigen::Vector3d& p : banks.vertices)
        EXPECT_GT(p.head<2>().norm(), 3) << p.transpose();
}

}  // namespace

}  // namespace reprise
