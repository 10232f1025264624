#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/paint/markings.h"
#include "tests/support/places.h"
#include "tests/support/worlds.h"
#include "world/town.h"

namespace reprise {

namespace {

using ground::GroundMesh;
using ground::Surface;
using test::plumb;
using world::LaneKind;
using world::LaneT;
using world::TownT;
using world::Vec3;

/// Half a car's track and a bit, both sides of every path.
template <typename Visit>
void for_each_wheel(const TownT& town, Visit&& visit) {
    for (const LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        for (double s = 0.05; s < lane.length; s += 0.7)
            for (const double t : {-0.9, 0.0, 0.9}) {
                const world::LanePoint at = world::point_at(lane, s);
                visit(lane,
                      Eigen::Vector3d(at.position.x() - t * std::sin(at.yaw),
                                      at.position.y() + t * std::cos(at.yaw),
                                      at.position.z()));
            }
    }
}

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

Eigen::Vector3d middle_of(const GroundMesh& mesh, std::size_t i) {
    const auto& [p, q, r] = mesh.triangles[i];
    return (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]) / 3;
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

Surface surface_at(const GroundMesh& mesh, double x, double y, double z = 0) {
    const auto hit = plumb(mesh, {x, y, z + 1});
    return hit ? hit->surface : Surface::marking;
}

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

}  // namespace

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

}  // namespace reprise
