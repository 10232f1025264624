// Roads under every wheel, bridges, and the terrain around them.
#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/paint/markings.h"
#include "tests/ground/mesh/mesh_checks.h"
#include "tests/support/places.h"
#include "tests/support/plumb_line.h"
#include "tests/support/worlds.h"
#include "world/town.h"

namespace reprise {

namespace {

using ground::GroundMesh;
using ground::Surface;
using test::expect_road_under_every_wheel;
using test::expect_well_formed;
using test::for_each_wheel;
using test::plumb;
using world::LaneKind;
using world::LaneT;
using world::TownT;

TEST(Ground, BridgesHaveSidesAndUndersidesClearOfTheRoadBelow) {
    const GroundMesh mesh = ground::build_ground(test::bridge());
    double lowest = 100;
    double underside = 0;  // [m2] that faces down
    double sides = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.surfaces[i] != Surface::deck)
            continue;
        const auto& [first, second, third] = mesh.triangles[i];
        const Eigen::Vector3d& p = mesh.vertices[first];
        const Eigen::Vector3d twice = (mesh.vertices[second] - p).cross(mesh.vertices[third] - p);
        lowest = std::min(lowest, p.z());
        underside += std::max(0.0, -twice.z()) / 2;
        sides += twice.head<2>().norm() / 2;
    }
    EXPECT_NEAR(lowest, 6 - 0.8, 1e-9);
    // Over the lower road at least; a lane of 3.5 m, so that the sides tell the same length.
    EXPECT_GT(underside, 3.5 * 3.5);
    EXPECT_NEAR(sides / (2 * 0.8), underside / 3.5, 0.1);
}

TEST(Ground, RoadsOnTheGroundHaveNoDeck) {
    for (const TownT& town : {test::t_junction(0), test::t_junction(0.05)}) {
        const GroundMesh mesh = ground::build_ground(town);
        EXPECT_EQ(std::count(mesh.surfaces.begin(), mesh.surfaces.end(), Surface::deck), 0);
    }
}

TEST(Ground, GivesEveryWheelRoadOnAStraightRoad) {
    expect_road_under_every_wheel(test::straight_road(120, 2));
}

TEST(Ground, GivesEveryWheelRoadThroughAJunction) {
    expect_road_under_every_wheel(test::t_junction());
}

TEST(Ground, GivesEveryWheelRoadThroughAJunctionOnASlope) {
    // Lanes are level across, a junction on a slope is not: 4.5 cm at 0.9 m.
    expect_road_under_every_wheel(test::t_junction(0.05));
}

TEST(Ground, GivesEveryWheelRoadOnAndBelowABridge) {
    const TownT town = test::bridge();
    expect_road_under_every_wheel(town);
    const GroundMesh mesh = ground::build_ground(town);
    EXPECT_NEAR(plumb(mesh, {0, 0, 9})->z, 6, 1e-9);
    EXPECT_NEAR(plumb(mesh, {0, 0, 3})->z, 0, 1e-9);
}

TEST(Ground, FillsAJunctionWhoseOutlineIsUseless) {
    TownT town = test::t_junction();
    using world::Vec3;
    const std::vector<std::vector<Vec3>> outlines{
        {},
        {Vec3(50, 0, 0), Vec3(50, 0, 0)},
        {Vec3(40, -6, 0), Vec3(60, 6, 0), Vec3(60, -6, 0), Vec3(40, 6, 0)},
        {Vec3(40, 0, 0), Vec3(50, 0, 0), Vec3(60, 0, 0)}};
    for (const std::vector<Vec3>& outline : outlines) {
        town.junctions[0].outline = outline;
        expect_road_under_every_wheel(town);
        expect_well_formed(ground::build_ground(town));
    }
}

TEST(Ground, KeepsTerrainBelowEveryRoad) {
    const std::vector<TownT> towns{test::bridge(), test::t_junction(0.1), test::t_junction(-0.03)};
    for (const TownT& town : towns) {
        const GroundMesh mesh = ground::build_ground(town);
        GroundMesh terrain{mesh.vertices, {}, {}};
        GroundMesh roads{mesh.vertices, {}, {}};
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            GroundMesh& part = mesh.surfaces[i] == Surface::terrain ? terrain : roads;
            part.triangles.push_back(mesh.triangles[i]);
            part.surfaces.push_back(mesh.surfaces[i]);
        }
        for_each_wheel(town, [&](const LaneT& lane, const Eigen::Vector3d& p) {
            const auto road = plumb(roads, p + Eigen::Vector3d(0, 0, 1));
            const auto below = plumb(terrain, p + Eigen::Vector3d(0, 0, 100));
            ASSERT_TRUE(road && below) << lane.name;
            EXPECT_LT(below->z, road->z - 0.049) << lane.name << " at " << p.transpose();
        });
    }
}

TEST(Ground, FollowsASlopeWithItsTerrain) {
    const double slope = 0.1;
    const GroundMesh mesh = ground::build_ground(test::t_junction(slope));
    for (double x = 5; x < 95; x += 5) {
        const auto beside = plumb(mesh, {x, 6.3, slope * x + 1});
        ASSERT_TRUE(beside);
        EXPECT_EQ(beside->surface, Surface::terrain);
        EXPECT_NEAR(beside->z, slope * x - 0.05, 0.02) << x;
    }
}

TEST(Ground, CatchesWhoeverLeavesTheRoad) {
    for (const TownT& town : {test::straight_road(100), test::bridge(), test::t_junction(0.05)}) {
        const GroundMesh mesh = ground::build_ground(town);
        for (double x = town.low.x() - 59; x < town.high.x() + 59; x += 13.3)
            for (double y = town.low.y() - 59; y < town.high.y() + 59; y += 13.3)
                EXPECT_TRUE(plumb(mesh, {x, y, 50})) << town.name << ' ' << x << ' ' << y;
    }
}

TEST(Ground, FacesUpAndHasNoSlivers) {
    for (const TownT& town :
         {test::straight_road(300, 3), test::bridge(), test::t_junction(), test::t_junction(0.05)})
        expect_well_formed(ground::build_ground(town));
}

TEST(Ground, CoversABendThatIsTighterThanTheLaneIsWide) {
    TownT town;
    town.lanes.push_back(
        test::lane("hairpin_0",
                   LaneKind::driving,
                   {{0, 0, 0}, {30, 0, 0}, {30.5, 0.5, 0}, {30, 1, 0}, {0, 4, 0}}));
    expect_road_under_every_wheel(town);
    expect_well_formed(ground::build_ground(town));
}

TEST(Ground, IsTheSameBytesEveryTime) {
    const TownT town = test::t_junction(0.07);
    const std::string first = test::bytes_of(ground::build_ground(town));
    const std::string markings = test::bytes_of(ground::build_markings(town));
    ground::build_ground(test::bridge());
    EXPECT_EQ(test::bytes_of(ground::build_ground(town)), first);
    EXPECT_EQ(test::bytes_of(ground::build_markings(town)), markings);
    EXPECT_NE(test::bytes_of(ground::build_ground(test::t_junction(0.06))), first);
}

TEST(Ground, OfNothingIsNothing) {
    EXPECT_TRUE(ground::build_ground(TownT()).triangles.empty());
    EXPECT_TRUE(ground::build_markings(TownT()).triangles.empty());
}

}  // namespace

}  // namespace reprise
