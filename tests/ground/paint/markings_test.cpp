#include "ground/paint/markings.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/support/places.h"
#include "tests/support/plumb_line.h"
#include "tests/support/worlds.h"

namespace reprise {

namespace {

using ground::GroundMesh;
using world::LaneT;
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
        const GroundMesh ground = ground::build_ground(town);
        const GroundMesh markings = ground::build_markings(town);
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

TEST(Markings, DashTheCentreLineInTownWhereNothingMeets) {
    const GroundMesh mesh = ground::build_markings(test::straight_road(90));
    EXPECT_NEAR(painted(mesh, 0, 90, -0.5, 0.5), 90 * line_width / 3, 1e-6);
}

TEST(Markings, KeepTheCentreLineSolidOnFastRoads) {
    TownT town = test::straight_road(90);
    for (world::LaneT& lane : town.lanes)
        lane.speed_limit = 70 / 3.6;
    const GroundMesh mesh = ground::build_markings(town);
    EXPECT_NEAR(painted(mesh, 0, 90, -0.5, 0.5), 90 * line_width, 1e-6);
}

TEST(Markings, KeepTheCentreLineSolidNearJunctions) {
    TownT town = test::straight_road(90);
    town.junctions.resize(1);
    town.junctions[0].lit = true;
    for (world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving && lane.centre.back().x() > 80)
            lane.junction = 0;
    const GroundMesh mesh = ground::build_markings(town);
    // 20 m, and the rest of the dash and gap that begin before.
    EXPECT_GE(painted(mesh, 60, 90, -0.5, 0.5), 20 * line_width - 1e-6);
    EXPECT_LE(painted(mesh, 60, 90, -0.5, 0.5), 29 * line_width);
    EXPECT_NEAR(painted(mesh, 0, 60, -0.5, 0.5), 60 * line_width / 3, 0.4);
}

TEST(Markings, KeepTheCentreLineSolidInABend) {
    // A quarter circle of 30 m radius between two roads of 100 m, both ways.
    TownT town;
    std::vector<world::Vec3> there;
    for (double x = 0; x < 100; x += 10)
        there.emplace_back(x, 0, 0);
    for (int i = 0; i <= 30; ++i) {
        const double angle = i * 1.5707963267948966 / 30;
        there.emplace_back(100 + 30 * std::sin(angle), 30 - 30 * std::cos(angle), 0);
    }
    for (double y = 40; y <= 130; y += 10)
        there.emplace_back(130, y, 0);
    const std::vector<world::Vec3> back(there.rbegin(), there.rend());
    town.lanes.push_back(test::lane("there_0", world::LaneKind::driving, there));
    town.lanes.push_back(test::lane("back_0", world::LaneKind::driving, back));
    town.lanes[0].opposite = 1;
    town.lanes[1].opposite = 0;
    const GroundMesh mesh = ground::build_markings(town);
    // Both lanes lie on one line here: the edge line of the way back is 0.15 m off the centre line.
    const double straight = painted(mesh, 20, 80, 1.69, 1.81);
    EXPECT_NEAR(straight, 60 * line_width / 3, 0.5);
    double solid = 0;
    for (const auto& [p, q, r] : mesh.triangles) {
        const Eigen::Vector3d middle = (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]) / 3;
        const double radius = (middle.head<2>() - Eigen::Vector2d(100, 30)).norm();
        if (middle.x() > 105 && middle.y() < 25 && std::abs(radius - 28.25) < 0.06)
            solid += (mesh.vertices[q] - mesh.vertices[p])
                         .cross(mesh.vertices[r] - mesh.vertices[p])
                         .norm() /
                     2;
    }
    // From 10 to 80 degrees.
    EXPECT_NEAR(solid, 28.25 * 1.2217 * line_width, 0.5);
}

TEST(Markings, DashTheLineBetweenLanesOfOneDirection) {
    const GroundMesh mesh = ground::build_markings(test::straight_road(90, 2));
    EXPECT_NEAR(painted(mesh, 0, 90, -4, -3), 90 * line_width / 3, 1e-6);
}

TEST(Markings, LeaveKerbsUnpaintedAndEdgeOpenRoads) {
    TownT town = test::straight_road(90);
    EXPECT_EQ(painted(ground::build_markings(town), 0, 90, -3.5, -3), 0);
    town.lanes[0].kind = world::LaneKind::other;
    EXPECT_NEAR(painted(ground::build_markings(town), 0, 90, -3.5, -3), 90 * line_width, 1e-6);
}

TEST(Markings, StopBeforeASignal) {
    const GroundMesh with = ground::build_markings(test::straight_road_with_signal(100));
    const GroundMesh without = ground::build_markings(test::straight_road(100));
    EXPECT_EQ(painted(without, 98, 100, -3.4, -0.2), 0);
    EXPECT_NEAR(painted(with, 99.2, 99.6, -3.5, -0.1), 0.4 * (3.5 - 2 * line_width), 1e-6);
    EXPECT_EQ(painted(with, 99.61, 100, -3.4, -0.2), 0);
}

namespace {

world::Link link_of(bool yields, world::Turn turn = world::Turn::straight) {
    return world::Link(world::none, world::none, world::none, turn, yields, 0);
}

/// Two roads of 100 m that meet at (100, 0) from the west (first lane) and the north (second).
TownT meeting(bool first_yields, bool second_yields) {
    TownT town;
    town.junctions.resize(1);
    town.lanes.push_back(test::lane("a_0", world::LaneKind::driving, {{0, 0, 0}, {100, 0, 0}}));
    town.lanes.push_back(test::lane("b_0", world::LaneKind::driving, {{105, 100, 0}, {105, 0, 0}}));
    town.lanes[0].links = {link_of(first_yields)};
    town.lanes[1].links = {link_of(second_yields)};
    for (world::LaneT& lane : town.lanes)
        lane.junction = 0;
    return town;
}

/// On the first of them, less its edge lines.
double painted_before_end(const TownT& town) {
    return painted(ground::build_markings(town), 98, 100, -1.5, 1.5);
}

}  // namespace

TEST(Markings, ShowTeethWhereOneMustGiveWay) {
    // Five teeth of 0.4 m by 0.6 m fit on a lane of 3.5 m.
    EXPECT_NEAR(painted_before_end(meeting(true, false)), 5 * 0.4 * 0.6 / 2, 1e-6);
    EXPECT_EQ(painted_before_end(meeting(false, true)), 0);
    TownT town = meeting(true, false);
    town.lanes[0].links.push_back(link_of(false));
    EXPECT_EQ(painted_before_end(town), 0) << "one way on has priority";
}

TEST(Markings, PointTeethAtTheDriver) {
    const GroundMesh mesh = ground::build_markings(meeting(true, false));
    const double near_half = painted(mesh, 98.9, 99.3, -1.5, 1.5);
    EXPECT_EQ(near_half, 0) << "middles of triangles lie towards their bases";
    EXPECT_GT(painted(mesh, 99.3, 99.6, -1.5, 1.5), 0.5);
}

TEST(Markings, LeaveJunctionsOfEqualsUnmarked) {
    EXPECT_EQ(painted_before_end(meeting(true, true)), 0);
}

TEST(Markings, ShowTeethBesideAYieldSign) {
    // At crossings the main road gives way as well, to walkers.
    TownT town = meeting(true, true);
    world::Prop sign;
    sign.mutate_kind(world::PropKind::yield_sign);
    sign.mutable_position() = world::Vec3(99, -3, 0);
    town.props.push_back(sign);
    EXPECT_NEAR(painted_before_end(town), 5 * 0.4 * 0.6 / 2, 1e-6);
}

TEST(Markings, StopBeforeAStopSign) {
    TownT town = meeting(true, false);
    world::Prop sign;
    sign.mutate_kind(world::PropKind::stop_sign);
    sign.mutable_position() = world::Vec3(99, -3, 0);
    town.props.push_back(sign);
    const double line = 0.4 * (3.5 - 2 * line_width);
    const auto whole = [](const TownT& painted_town) {
        return painted(ground::build_markings(painted_town), 99.2, 99.6, -2, 2);
    };
    EXPECT_NEAR(whole(town), line, 0.1);
    // Not those of others: turned away from this lane, or far away.
    town.props[0].mutate_yaw(3.1);
    EXPECT_LT(whole(town), line - 0.3);
    town.props[0].mutate_yaw(0);
    town.props[0].mutable_position() = world::Vec3(80, -3, 0);
    EXPECT_LT(whole(town), line - 0.3);
}

TEST(Markings, ShowArrowsOnlyWhereLanesLeadToDifferentTurns) {
    using world::Turn;
    TownT town = meeting(false, true);
    LaneT inner = test::lane("a_1", world::LaneKind::driving, {{0, 3.5, 0}, {100, 3.5, 0}});
    inner.junction = 0;
    inner.links = {link_of(false, Turn::straight)};
    inner.right = 0;
    town.lanes.insert(town.lanes.begin() + 1, inner);
    town.lanes[0].left = 1;
    const auto arrows = [&](double y) {
        return painted(ground::build_markings(town), 60, 94, y - 1.3, y + 1.3);
    };
    EXPECT_EQ(arrows(0), 0) << "both lanes lead straight on";
    EXPECT_EQ(arrows(3.5), 0);

    town.lanes[0].links = {link_of(false, Turn::right)};
    EXPECT_GT(arrows(0), 1) << "two arrows";
    EXPECT_GT(arrows(3.5), 1);
    // To the right of the lane's middle is more paint than to its left; straight on is even.
    const GroundMesh mesh = ground::build_markings(town);
    EXPECT_GT(painted(mesh, 60, 94, -1.3, -0.1), 2 * painted(mesh, 60, 94, 0.1, 1.3));
    EXPECT_NEAR(painted(mesh, 60, 94, 3.5, 4.8), painted(mesh, 60, 94, 2.2, 3.5), 0.2);
}

TEST(Markings, StripeHalfOfACrossing) {
    const GroundMesh mesh = ground::build_markings(test::t_junction());
    EXPECT_NEAR(painted(mesh, 46.5, 53.5, -14, -11), 7 * 3 / 2.0, 1e-6);
}

}  // namespace reprise
