#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tests/world/places.h"
#include "world/ground.h"

namespace reprise {

namespace {

using world::GroundMesh;
using world::TownT;

/// Painted area within a rectangle, by triangle middles. [m2]
double painted(const GroundMesh& mesh, double x0, double x1, double y0, double y1) {
    double area = 0;
    for (const auto& [p, q, r] : mesh.triangles) {
        const Eigen::Vector3d middle = (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]) / 3;
        if (middle.x() > x0 && middle.x() < x1 && middle.y() > y0 && middle.y() < y1)
            area += (mesh.vertices[q] - mesh.vertices[p])
                        .cross(mesh.vertices[r] - mesh.vertices[p])
                        .z() /
                    2;
    }
    return area;
}

constexpr double line_width = 0.12;

}  // namespace

TEST(Markings, LieFiveMillimetresAboveTheRoad) {
    for (const double slope : {0.0, 0.06}) {
        const TownT town = test::t_junction(slope);
        const GroundMesh ground = world::build_ground(town);
        const GroundMesh markings = world::build_markings(town);
        ASSERT_FALSE(markings.triangles.empty());
        for (const auto& [p, q, r] : markings.triangles) {
            const Eigen::Vector3d middle =
                (markings.vertices[p] + markings.vertices[q] + markings.vertices[r]) / 3;
            const auto road = test::plumb(ground, middle + Eigen::Vector3d(0, 0, 1));
            ASSERT_TRUE(road);
            EXPECT_NEAR(middle.z() - road->z, 0.005, 0.003) << middle.transpose();
        }
    }
}

TEST(Markings, DrawOneSolidLineBetweenOppositeDirections) {
    const GroundMesh mesh = world::build_markings(test::straight_road(90));
    EXPECT_NEAR(painted(mesh, 0, 90, -0.5, 0.5), 90 * line_width, 1e-6);
}

TEST(Markings, DashTheLineBetweenLanesOfOneDirection) {
    const GroundMesh mesh = world::build_markings(test::straight_road(90, 2));
    EXPECT_NEAR(painted(mesh, 0, 90, -4, -3), 90 * line_width / 3, 1e-6);
}

TEST(Markings, LeaveKerbsUnpaintedAndEdgeOpenRoads) {
    TownT town = test::straight_road(90);
    EXPECT_EQ(painted(world::build_markings(town), 0, 90, -3.5, -3), 0);
    town.lanes[0].kind = world::LaneKind::other;
    EXPECT_NEAR(painted(world::build_markings(town), 0, 90, -3.5, -3), 90 * line_width, 1e-6);
}

TEST(Markings, StopBeforeASignal) {
    const GroundMesh with = world::build_markings(test::straight_road_with_signal(100));
    const GroundMesh without = world::build_markings(test::straight_road(100));
    EXPECT_EQ(painted(without, 98, 100, -3.4, -0.2), 0);
    EXPECT_NEAR(painted(with, 99.2, 99.6, -3.5, -0.1), 0.4 * (3.5 - 2 * line_width), 1e-6);
    EXPECT_EQ(painted(with, 99.61, 100, -3.4, -0.2), 0);
}

TEST(Markings, StopWhereEveryWayOnMustYield) {
    TownT town = test::straight_road(100);
    const auto link = [](bool yields) {
        return world::Link(world::none, world::none, world::none, world::Turn::straight, yields, 0);
    };
    town.lanes[1].links = {link(true), link(false)};
    EXPECT_EQ(painted(world::build_markings(town), 98, 100, -3.4, -0.2), 0);
    town.lanes[1].links = {link(true), link(true)};
    EXPECT_GT(painted(world::build_markings(town), 98, 100, -3.4, -0.2), 1);
}

TEST(Markings, StripeHalfOfACrossing) {
    const GroundMesh mesh = world::build_markings(test::t_junction());
    EXPECT_NEAR(painted(mesh, 46.5, 53.5, -14, -11), 7 * 3 / 2.0, 1e-6);
}

}  // namespace reprise
