#include "towns/check/standing_check.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground_probe.h"
#include "tests/support/places.h"
#include "tests/support/plumb_line.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise {
namespace {

using towns::Criterion;
using world::Prop;
using world::PropKind;
using world::TownT;
using world::Vec3;

constexpr std::size_t things = 0;
constexpr std::size_t doors = 1;
constexpr std::size_t on_roads = 2;

std::vector<Criterion> check(const TownT& town) {
    return towns::check_standing(town, ground::build_ground(town));
}

Prop prop(PropKind kind, const Vec3& foot, double yaw = 0, double length = 1, double width = 1) {
    return Prop(foot, yaw, length, width, 1, 0, 0, kind, 0);
}

/// What a plumb line that starts at this height meets.
Vec3 on_ground(const TownT& town, double x, double y, double from = 100) {
    const auto hit = test::plumb(ground::build_ground(town), {x, y, from});
    EXPECT_TRUE(hit.has_value());
    return {x, y, hit ? hit->z : 0};
}

Vec3 raised(const Vec3& foot, double by) {
    return {foot.x(), foot.y(), foot.z() + by};
}

TEST(StandingCheck, FindsWhatFloatsAndWhatIsSunk) {
    TownT town = test::t_junction(0.05);
    const Vec3 foot = on_ground(town, 30, 40);
    for (const double off : {0.0, 0.2, -0.2})
        EXPECT_TRUE((town.trees = {world::Tree(raised(foot, off), 8, 2, 0, {})},
                     check(town)[things].passed()))
            << off;
    for (const double off : {0.3, -0.3, 5.0}) {
        town.trees = {world::Tree(raised(foot, off), 8, 2, 0, {})};
        const Criterion found = check(town)[things];
        EXPECT_FALSE(found.passed());
        EXPECT_NEAR(found.figure, std::abs(off), 1e-9);
        EXPECT_EQ(found.worst[0].name, "plant 0");
    }
    town.trees.clear();
    town.props = {prop(PropKind::bin, foot)};
    town.heads.resize(1);
    town.heads[0].foot = foot;
    EXPECT_TRUE(check(town)[things].passed());
    town.heads[0].foot = raised(foot, 1);
    EXPECT_EQ(check(town)[things].worst.at(0).name, "signal head 0");
}

TEST(StandingCheck, FollowsLongThingsToTheirEnds) {
    TownT town = test::t_junction(0.1);
    const Vec3 foot = on_ground(town, 30, 12);
    town.props = {prop(PropKind::fence, foot, 0, 4, 0.1)};
    EXPECT_TRUE(check(town)[things].passed()) << "0.2 m at its ends";
    town.props = {prop(PropKind::fence, foot, 0, 8, 0.1)};
    EXPECT_NEAR(check(town)[things].figure, 0.4, 0.05);
    town.props = {prop(PropKind::fence, foot, std::acos(0.0), 8, 0.1)};
    EXPECT_TRUE(check(town)[things].passed()) << "level across the slope";
}

TEST(StandingCheck, KnowsTheLevelsOfABridge) {
    TownT town = test::bridge();
    town.props = {prop(PropKind::bin, Vec3(0, 0, 6)),
                  prop(PropKind::bin, Vec3(0, 0, 0)),
                  prop(PropKind::wall, Vec3(1.85, 5, 6), std::acos(0.0), 2, 0.2)};
    EXPECT_TRUE(check(town)[things].passed()) << "on it, under it, and at its edge";
    town.props = {prop(PropKind::bin, Vec3(0, 0, 3))};
    EXPECT_NEAR(check(town)[things].figure, 3, 0.1);
    town.props = {prop(PropKind::bin, Vec3(2.3, 5, 6))};
    EXPECT_GT(check(town)[things].figure, 3) << "beside it";
}

TEST(StandingCheck, WantsDoorsThatOneCanReach) {
    TownT town = test::t_junction(0.05);
    // Its front, at -y, is at y = 8.
    const Vec3 door = on_ground(town, 20, 7.7);
    const auto house = [&](double z) {
        return world::Building(Vec3(20, 12, z), 0, 10, 8, 6, 0, 1);
    };
    town.buildings = {house(door.z() + 0.05)};
    EXPECT_TRUE(check(town)[doors].passed());
    for (const double off : {0.5, -0.5, 9.0}) {
        town.buildings = {house(door.z() + off)};
        const Criterion found = check(town)[doors];
        EXPECT_NEAR(found.figure, std::abs(off), 1e-6);
        EXPECT_EQ(found.worst.at(0).name, "building 0");
    }
}

TEST(StandingCheck, IsContentWithOneDoorOfADrawnBuilding) {
    TownT town = test::t_junction(0.1);
    world::DrawnBuildingT drawn;
    const double z = on_ground(town, 9.7, 24).z();
    drawn.outline = {{10, 20, z}, {22, 20, z}, {22, 28, z}, {10, 28, z}};
    drawn.height = 6;
    town.drawn_buildings = {drawn};
    EXPECT_TRUE(check(town)[doors].passed()) << "its western side; the others are lower";
    for (Vec3& corner : town.drawn_buildings[0].outline)
        corner.mutate_z(z - 0.5);
    EXPECT_EQ(check(town)[doors].worst.at(0).name, "drawn building 0");
}

TEST(StandingCheck, FindsWhatGrowsOrStandsInARoad) {
    TownT town = test::t_junction();
    const auto lane = std::find_if(town.lanes.begin(), town.lanes.end(), [](const auto& each) {
        return each.kind == world::LaneKind::driving;
    });
    const auto beside = [&](double share_of_half) {
        const world::LanePoint at = world::point_at(*lane, lane->length / 2);
        const Eigen::Vector2d p =
            at.position.head<2>() - world::left_of(at.yaw) * (share_of_half * lane->width / 2);
        return on_ground(town, p.x(), p.y());
    };
    // Near its edge, where no centre line is near; and 10 m beside it.
    const Vec3 edge = beside(0.9), off = beside(1 + 20 / lane->width);
    town.trees = {world::Tree(off, 8, 2, 0, {})};
    town.props = {prop(PropKind::bin, off), prop(PropKind::parked_vehicle, edge)};
    EXPECT_TRUE(check(town)[on_roads].passed());
    town.trees = {world::Tree(edge, 8, 2, 0, {})};
    EXPECT_EQ(check(town)[on_roads].worst.at(0).name, "plant 0");
    town.trees.clear();
    town.props = {prop(PropKind::bin, edge)};
    EXPECT_EQ(check(town)[on_roads].worst.at(0).name, "bin 0");
}

TEST(StandingCheck, SaysWhatStandsBeyondTheTerrain) {
    TownT town = test::t_junction(0.05);
    town.trees = {world::Tree(Vec3(5000, 0, 0), 8, 2, 0, {})};
    EXPECT_FALSE(check(town)[things].passed());
}

}  // namespace
}  // namespace reprise
