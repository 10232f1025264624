// Sidewalks, their kerbs, and crossings.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
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
using test::expect_road_under_every_wheel;
using test::expect_well_formed;
using test::normal_of;
using test::plumb;
using test::surface_at;
using world::LaneKind;
using world::LaneT;
using world::TownT;
using world::Vec3;

Eigen::Vector3d middle_of(const GroundMesh& mesh, std::size_t i) {
    const auto& [p, q, r] = mesh.triangles[i];
    return (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]) / 3;
}

TEST(Ground, AFootpathAcrossASlopeLeavesTheRoadClear) {
    // Two points each: the road's mean height is 5 m below that of the footpath.
    TownT town;
    town.name = "slope";
    town.lanes = {test::lane("path_0", LaneKind::sidewalk, {{140, -30, 11.2}, {140, 30, 11.2}}),
                  test::lane("up_0", LaneKind::driving, {{0, 0, 0}, {150, 0, 12}})};
    town.low = {0, -30, 0};
    town.high = {150, 30, 12};
    expect_road_under_every_wheel(town);
    EXPECT_EQ(surface_at(ground::build_ground(town), 140, 10, 11.2), Surface::sidewalk);
}

TEST(Ground, AFootpathUnderASlopeStaysWhole) {
    // At the road's mean height, but 6 m below it where it passes.
    TownT town;
    town.name = "slope";
    town.lanes = {test::lane("path_0", LaneKind::sidewalk, {{150, -30, 6}, {150, 30, 6}}),
                  test::lane("up_0", LaneKind::driving, {{0, 0, 0}, {150, 0, 12}})};
    town.low = {0, -30, 0};
    town.high = {150, 30, 12};
    const GroundMesh mesh = ground::build_ground(town);
    EXPECT_EQ(surface_at(mesh, 149.5, 0, 6), Surface::sidewalk);
}

TEST(Ground, CutsASidewalkThatLiesOnADrivingLane) {
    TownT town = test::straight_road(100);
    // As in real networks: 2 m off to the side.
    for (world::Vec3& p : town.lanes[0].centre)
        p = world::Vec3(p.x(), p.y() + 2, p.z());
    expect_road_under_every_wheel(town);
    EXPECT_EQ(surface_at(ground::build_ground(town), 50, -3.7), Surface::sidewalk);
}

TEST(Ground, CutsOnlyWhatLiesOnTheSameLevel) {
    TownT town = test::bridge();
    LaneT sidewalk = test::lane("walk_0", LaneKind::sidewalk, {{-80, 3, 0}, {80, 3, 0}});
    town.lanes.push_back(sidewalk);
    const GroundMesh mesh = ground::build_ground(town);
    EXPECT_EQ(plumb(mesh, {0, 3, 9})->surface, Surface::road);
    EXPECT_EQ(plumb(mesh, {0, 3, 3})->surface, Surface::sidewalk);
}

TEST(Ground, RaisesSidewalksByAKerb) {
    for (const double slope : {0.0, 0.05}) {
        const GroundMesh mesh = ground::build_ground(test::t_junction(slope));
        const Eigen::Vector2d on_sidewalk(20, -4.75);
        const Eigen::Vector2d on_walking_area(50, 5);
        for (const Eigen::Vector2d& p : {on_sidewalk, on_walking_area}) {
            const double road = slope * p.x();
            const auto hit = plumb(mesh, {p.x(), p.y(), road + 1});
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->surface, Surface::sidewalk);
            EXPECT_NEAR(hit->z, road + ground::kerb_height, 0.01);
        }
    }
}

TEST(Ground, LeavesCrossingsAtRoadLevel) {
    const GroundMesh mesh = ground::build_ground(test::t_junction());
    for (double x = 46.6; x < 53.5; x += 0.4)
        for (double y = -13.9; y < -11; y += 0.4) {
            const auto hit = plumb(mesh, {x, y, 1});
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->surface, Surface::crossing) << x << ' ' << y;
            EXPECT_NEAR(hit->z, 0, 1e-9);
        }
}

TEST(Ground, TurnsKerbFacesAwayFromTheSlab) {
    const GroundMesh mesh = ground::build_ground(test::t_junction());
    int faces = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.surfaces[i] != Surface::kerb)
            continue;
        const Eigen::Vector3d inward = -0.02 * normal_of(mesh, i).normalized();
        const Eigen::Vector3d middle = middle_of(mesh, i);
        EXPECT_EQ(surface_at(mesh, middle.x() + inward.x(), middle.y() + inward.y()),
                  Surface::sidewalk)
            << middle.transpose();
        ++faces;
    }
    EXPECT_GT(faces, 20);
}

TEST(Ground, ClosesEveryEdgeOfASlab) {
    // Along the road's edge of the northern sidewalk a face stands wherever one looks.
    const GroundMesh mesh = ground::build_ground(test::t_junction());
    for (double x = 1; x < 99; x += 1) {
        bool closed = false;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            if (mesh.surfaces[i] != Surface::kerb || normal_of(mesh, i).normalized().y() > -0.99)
                continue;
            double low = 1e9;
            double high = -1e9;
            for (const std::uint32_t vertex : mesh.triangles[i]) {
                low = std::min(low, mesh.vertices[vertex].x());
                high = std::max(high, mesh.vertices[vertex].x());
            }
            const double y = middle_of(mesh, i).y();
            closed = closed || (low <= x && x <= high && std::abs(y - 3.5) < 0.01);
        }
        EXPECT_TRUE(closed) << "x = " << x;
    }
}

TEST(Ground, LeavesNoFaceBetweenSlabsThatMeet) {
    const GroundMesh mesh = ground::build_ground(test::t_junction());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.surfaces[i] != Surface::kerb)
            continue;
        const Eigen::Vector3d middle = middle_of(mesh, i);
        const bool across_north_sidewalk =
            middle.y() > 3.6 && middle.y() < 5.9 && middle.x() > 1 && middle.x() < 99;
        EXPECT_FALSE(across_north_sidewalk) << middle.transpose();
    }
}

TEST(Ground, LeavesNoKerbBetweenThePathsOfABend) {
    const TownT town = test::bend();
    const GroundMesh mesh = ground::build_ground(town);
    // Between the paths, and behind the ends of the lanes, which the paths leave at an angle.
    for (const Eigen::Vector2d& p :
         std::vector<Eigen::Vector2d>{{3.6, 1.5}, {1.4, 5.7}, {8.6, 1.07}, {8.86, -1.95}})
        EXPECT_EQ(surface_at(mesh, p.x(), p.y()), Surface::road) << p.transpose();
    EXPECT_EQ(surface_at(mesh, -3.2, 10), Surface::sidewalk);
    EXPECT_EQ(surface_at(mesh, 5.5, 5.5), Surface::sidewalk) << "the inner corner is walked on";
    expect_well_formed(mesh);
    expect_road_under_every_wheel(town);
}

/// A lane that ends at (50, 0), a path that leaves it at an angle of 45 degrees, and a walking area
/// along its right side.
TownT sharp_turn() {
    TownT town;
    town.lanes = {test::lane(":j_0_0", LaneKind::internal, {{50, 0, 0}, {60, 10, 0}}),
                  test::lane(":j_w0_0", LaneKind::walking_area, {{50, -5, 0}, {60, -5, 0}}),
                  test::lane("in_1", LaneKind::driving, {{0, 0, 0}, {50, 0, 0}})};
    town.lanes[1].outline = {{50, -6, 0}, {60, -6, 0}, {60, -0.9, 0}, {50, -0.9, 0}};
    town.lanes[2].links = {{0, world::none, world::none, world::Turn::left, false, 0}};
    town.low = Vec3(0, -6, 0);
    town.high = Vec3(60, 12, 1);
    return town;
}

TEST(Ground, KerbsKeepClearOfTheCornerWhereAPathTurnsOffItsLane) {
    const GroundMesh mesh = ground::build_ground(sharp_turn());
    EXPECT_EQ(surface_at(mesh, 55, -3), Surface::sidewalk);
    EXPECT_NE(surface_at(mesh, 50.8, -1.2), Surface::sidewalk);
}

/// Two carriageways with a strip of `width` between them, and a crossing over both.
TownT refuge(double width) {
    TownT town;
    town.lanes = {
        test::lane(":r_c0_0", LaneKind::crossing, {{50, -3.5, 0}, {50, 0, 0}}),
        test::lane(":r_c1_0", LaneKind::crossing, {{50, width, 0}, {50, width + 3.5, 0}}),
        test::lane(":r_w0_0", LaneKind::walking_area, {{48, width / 2, 0}, {52, width / 2, 0}}),
        test::lane("there_0", LaneKind::driving, {{0, -1.75, 0}, {100, -1.75, 0}}),
        test::lane("back_0", LaneKind::driving, {{100, width + 1.75, 0}, {0, width + 1.75, 0}})};
    town.lanes[0].outline = {{48, -3.5, 0}, {52, -3.5, 0}, {52, 0, 0}, {48, 0, 0}};
    town.lanes[1].outline = {
        {48, width, 0}, {52, width, 0}, {52, width + 3.5, 0}, {48, width + 3.5, 0}};
    town.lanes[2].outline = {{48.6, 0, 0}, {51.4, 0, 0}, {51.4, width, 0}, {48.6, width, 0}};
    town.low = Vec3(0, -4, 0);
    town.high = Vec3(100, width + 4, 1);
    return town;
}

TEST(Ground, RefugesOnCrossingsStayWhenTheyHoldAPerson) {
    EXPECT_EQ(surface_at(ground::build_ground(refuge(1.2)), 50, 0.6), Surface::sidewalk);
    EXPECT_NE(surface_at(ground::build_ground(refuge(0.4)), 50, 0.2), Surface::sidewalk);
    TownT without = refuge(1.2);
    without.lanes.erase(without.lanes.begin(), without.lanes.begin() + 2);
    EXPECT_NE(surface_at(ground::build_ground(without), 50, 0.6), Surface::sidewalk);
}

}  // namespace

}  // namespace reprise
