#include "walkers/map/walk_map.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/obstacles.h"
#include "tests/support/towns.h"
#include "walkers/walking_ground.h"

namespace reprise::walkers {
namespace {

using Eigen::Vector3d;
using ground::GroundMesh;
using ground::Surface;

void add_rectangle(
    GroundMesh& mesh, double x0, double y0, double x1, double y1, double z, Surface surface) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.surfaces.insert(mesh.surfaces.end(), 2, surface);
}

/// A road of 100 m by 7 m along x with sidewalks of 2.5 m on both sides, and a crossing at x = 40
/// to 43 unless one does without.
GroundMesh street(bool with_crossing, double z = 0) {
    GroundMesh mesh;
    add_rectangle(mesh, 0, -6, 100, -3.5, z + 0.15, Surface::sidewalk);
    add_rectangle(mesh, 0, 3.5, 100, 6, z + 0.15, Surface::sidewalk);
    if (with_crossing) {
        add_rectangle(mesh, 0, -3.5, 40, 3.5, z, Surface::road);
        add_rectangle(mesh, 40, -3.5, 43, 3.5, z, Surface::crossing);
        add_rectangle(mesh, 43, -3.5, 100, 3.5, z, Surface::road);
    } else {
        add_rectangle(mesh, 0, -3.5, 100, 3.5, z, Surface::road);
    }
    return mesh;
}

double metres_on(const std::vector<WalkMap::Step>& steps, Surface surface) {
    double metres = 0;
    for (std::size_t i = 0; i + 1 < steps.size(); ++i)
        if (steps[i].surface == surface)
            metres += (steps[i + 1].position - steps[i].position).norm();
    return metres;
}

TEST(WalkMap, TakesTheCrossingWhereItIsNotFar) {
    const WalkMap map(street(true));
    const auto way = map.path({30, -5, 0.15}, {30, 5, 0.15});
    ASSERT_TRUE(way);
    EXPECT_LT(metres_on(*way, Surface::road), 1);
    EXPECT_NEAR(metres_on(*way, Surface::crossing), 7, 1.5);
    EXPECT_LT((way->front().position - Vector3d(30, -5, 0.15)).norm(), 0.3);
    EXPECT_LT((way->back().position - Vector3d(30, 5, 0.15)).norm(), 0.3);
}

TEST(WalkMap, CrossesTheRoadWhereThereIsNoCrossing) {
    const auto way = WalkMap(street(false)).path({30, -5, 0.15}, {30, 5, 0.15});
    ASSERT_TRUE(way);
    EXPECT_NEAR(metres_on(*way, Surface::road), 7, 1.5);
}

TEST(WalkMap, StaysOnTheSidewalkAlongAStreet) {
    const auto way = WalkMap(street(true)).path({2, 5, 0.15}, {98, 5, 0.15});
    ASSERT_TRUE(way);
    EXPECT_NEAR(metres_on(*way, Surface::sidewalk), 96, 0.5) << "over the border of two tiles";
}

TEST(WalkMap, KeepsStoreysApart) {
    GroundMesh mesh = street(true);
    const GroundMesh bridge = street(true, 6);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), bridge.vertices.begin(), bridge.vertices.end());
    for (auto triangle : bridge.triangles)
        mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
    mesh.surfaces.insert(mesh.surfaces.end(), bridge.surfaces.begin(), bridge.surfaces.end());
    const WalkMap map(mesh);
    EXPECT_TRUE(map.path({10, 5, 6.15}, {90, 5, 6.15}));
    EXPECT_TRUE(map.path({10, 5, 0.15}, {90, 5, 0.15}));
    EXPECT_FALSE(map.path({10, 5, 0.15}, {90, 5, 6.15}));
}

TEST(WalkMap, SaysWhenThereIsNoWay) {
    GroundMesh mesh = street(true);
    add_rectangle(mesh, 0, 20, 100, 23, 0.15, Surface::sidewalk);
    const WalkMap map(mesh);
    EXPECT_FALSE(map.path({10, 5, 0.15}, {10, 21, 0.15})) << "an island";
    EXPECT_FALSE(map.path({10, 5, 0.15}, {10, 60, 0.15})) << "nothing there";
    EXPECT_FALSE(WalkMap(GroundMesh()).path({0, 0, 0}, {1, 1, 0}));
}

TEST(WalkMap, NobodyWalksOnTerrain) {
    GroundMesh mesh;
    add_rectangle(mesh, 0, 0, 50, 50, 0, Surface::terrain);
    EXPECT_EQ(WalkMap(mesh).polygons(), 0U);
}

/// Two sidewalks that cross in the far corner of a town of 8 by 8 km.
TEST(WalkMap, HoldsATownOfManySquares) {
    GroundMesh mesh;
    add_rectangle(mesh, 0, 0, 8000, 3, 0.15, Surface::sidewalk);
    add_rectangle(mesh, 7997, 3, 8000, 8000, 0.15, Surface::sidewalk);
    const WalkMap map(mesh);
    const auto way = map.path({7600, 1.5, 0.15}, {7998.5, 400, 0.15});
    ASSERT_TRUE(way);
    EXPECT_NEAR(metres_on(*way, Surface::sidewalk), 398.5 + 398.5, 5);
}

/// As people on foot get it. Where every step of an oblique kerb stays a corner, it is twenty times
/// as many.
TEST(WalkMap, AStreetAskewHasFewPolygonsToo) {
    const world::TownT town;
    const GroundMesh straight = street(true);
    for (const double degrees : {8., 27., 45., 63.}) {
        GroundMesh askew = straight;
        const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Vector3d::UnitZ());
        for (Vector3d& vertex : askew.vertices)
            vertex = turn * vertex;
        EXPECT_LT(WalkingGround(town, &askew).streets().polygons(),
                  5 * WalkingGround(town, &straight).streets().polygons())
            << degrees << " degrees";
    }
}

/// Shoulders are half a metre wide.
TEST(WalkMap, EndsAShoulderBesideBenchesAndMailboxes) {
    const world::TownT& town = test::own_town("town1").town;
    WalkingGround ground(town);
    const WalkMap& map = ground.pavement();
    constexpr double shoulder = 0.23;
    int beside = 0;
    for (const world::Obstacle& thing : ground::obstacles_of(town)) {
        if (thing.shape != world::Obstacle::Shape::box || thing.radius > 1.5)
            continue;
        const Eigen::Rotation2Dd turn(thing.yaw);
        for (const Eigen::Vector2d& side : {Eigen::Vector2d(1, 0.5),
                                            Eigen::Vector2d(1, -0.5),
                                            Eigen::Vector2d(-1, 0),
                                            Eigen::Vector2d(0, 1),
                                            Eigen::Vector2d(0.5, -1),
                                            Eigen::Vector2d(-0.5, -1)}) {
            const Eigen::Vector2d edge = turn * side.cwiseProduct(thing.half.head<2>());
            const auto place = map.nearest(thing.position + Vector3d(edge.x(), edge.y(), 0));
            if (!place)
                continue;
            const Eigen::Vector2d to =
                turn.inverse() * (place->position - thing.position).head<2>();
            const Eigen::Vector2d gap = (to.cwiseAbs() - thing.half.head<2>()).cwiseMax(0.0);
            EXPECT_GE(gap.norm(), shoulder) << "at " << place->position.transpose();
            ++beside;
        }
    }
    EXPECT_GT(beside, 100);
}

/// [m] of a point outside of a convex outline.
double distance_to(const world::Loop& outline, const Eigen::Vector2d& p) {
    double least = 1e9;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d& from = outline[i];
        const Eigen::Vector2d along = outline[(i + 1) % outline.size()] - from;
        const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (from + t * along - p).norm());
    }
    return least;
}

/// Of a house on a pavement, turned and moved by parts of a cell: the least room that is left
/// around its corners. [m]
double room_around(const world::Loop& house) {
    double least = 1e9;
    for (int turn = 0; turn < 36; ++turn) {
        GroundMesh mesh;
        add_rectangle(mesh, 0, 0, 30, 30, 0.15, Surface::sidewalk);
        const Eigen::Rotation2Dd turned(turn * std::numbers::pi / 18);
        world::Obstacle prism;
        prism.shape = world::Obstacle::Shape::prism;
        prism.position = Vector3d(15 + 0.03 * turn, 15 + 0.017 * turn, 0.15);
        prism.half = Vector3d(5, 5, 5);
        prism.radius = 6;
        world::Loop outline;
        for (const Eigen::Vector2d& corner : house) {
            const Eigen::Vector2d there = turned * corner;
            prism.corners.emplace_back(there.x(), there.y(), 0);
            outline.emplace_back(prism.position.head<2>() + there);
        }
        TileRules rules;  // as people on foot get it
        rules.cell = 0.2F;
        rules.radius = 2;
        rules.simplification = 1.1F;
        rules.heights = false;
        const WalkMap map(mesh, rules, {&prism, 1});
        for (const Eigen::Vector2d& corner : outline)
            for (int i = 0; i < 24; ++i) {
                const Eigen::Vector2d beside =
                    corner +
                    Eigen::Rotation2Dd(i * std::numbers::pi / 12) * Eigen::Vector2d(0.2, 0);
                if (world::contains(outline, beside))
                    continue;
                const auto place = map.nearest({beside.x(), beside.y(), 0.15});
                if (place)
                    least = std::min(least, distance_to(outline, place->position.head<2>()));
            }
    }
    return least;
}

TEST(WalkMap, LeavesAShoulderAroundTheCornersOfHouses) {
    constexpr double shoulder = 0.23;
    EXPECT_GE(room_around({{-4, -2}, {4, -2}, {4, 2}, {-4, 2}}), shoulder);
    EXPECT_GE(room_around({{4, 2}, {-4, 2}, {-4, -2}, {4, -2}}), shoulder) << "clockwise";
    EXPECT_GE(room_around({{-4, -2}, {4, -2}, {-4, 2}}), shoulder) << "acute";
}

TEST(WalkMap, IsTheSameBytesEveryTime) {
    const GroundMesh mesh = street(true);
    const WalkMap map(mesh);
    EXPECT_EQ(map.digest(), WalkMap(mesh).digest());
    EXPECT_FALSE(map.digest() == WalkMap(street(false)).digest());
    // Asking for ways leaves no trace.
    const auto first = map.path({30, -5, 0.15}, {80, 5, 0.15});
    map.path({5, 5, 0.15}, {90, -5, 0.15});
    const auto second = map.path({30, -5, 0.15}, {80, 5, 0.15});
    ASSERT_TRUE(first && second);
    ASSERT_EQ(first->size(), second->size());
    for (std::size_t i = 0; i < first->size(); ++i)
        EXPECT_EQ((*first)[i].position, (*second)[i].position);
}

TEST(WalkMap, MeansTheSameFarFromTheOrigin) {
    GroundMesh mesh = street(true);
    for (Vector3d& vertex : mesh.vertices)
        vertex += Vector3d(500000, -2000000, 300);
    const auto way = WalkMap(mesh).path({500030, -2000005, 300.15}, {500030, -1999995, 300.15});
    ASSERT_TRUE(way);
    EXPECT_NEAR(metres_on(*way, Surface::crossing), 7, 1.5);
}

}  // namespace
}  // namespace reprise::walkers
