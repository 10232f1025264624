#include "towns/check/furniture_check.h"

#include <gtest/gtest.h>

#include "ground/swept_area.h"
#include "tests/support/places.h"
#include "tests/support/worlds.h"
#include "world/town.h"

namespace reprise {
namespace {

using towns::Criterion;
using world::TownT;

constexpr std::size_t heads = 0;
constexpr std::size_t spawn_points = 1;
constexpr std::size_t ways = 2;
constexpr std::size_t bends = 3;

std::uint32_t at(const TownT& town, const char* name) {
    return *world::find_lane(town, name);
}

world::SpawnPoint spawn(const TownT& town, const char* lane, double s) {
    const Eigen::Vector3d p = world::point_at(town.lanes[at(town, lane)], s).position;
    world::SpawnPoint point;
    point.mutable_position() = world::Vec3(p.x(), p.y(), p.z());
    point.mutate_s(s);
    point.mutate_lane(at(town, lane));
    return point;
}

world::Building house(double x, double y) {
    world::Building building;
    building.mutable_centre() = world::Vec3(x, y, 0);
    building.mutate_length(10);
    building.mutate_width(8);
    building.mutate_height(6);
    return building;
}

TEST(FurnitureCheck, WantsAHeadForEverySignal) {
    TownT town = test::t_junction();
    town.signals.resize(3);
    for (world::SignalT& signal : town.signals) {
        signal.program = "t";
        signal.lane = at(town, "west_in_1");
    }
    town.signals[2].lane = at(town, "east_in_1");
    EXPECT_EQ(towns::check_furniture(town)[heads].figure, 2) << "two lanes";
    town.heads.resize(1);
    town.heads[0].signals = {0, 1};
    const Criterion dark = towns::check_furniture(town)[heads];
    EXPECT_EQ(dark.figure, 1);
    EXPECT_EQ(dark.worst[0].name, "t for east_in_1");
    town.heads[0].signals = {0, 1, 2};
    EXPECT_TRUE(towns::check_furniture(town)[heads].passed());
}

TEST(FurnitureCheck, WantsSpawnPointsOnTheirLanes) {
    TownT town = test::t_junction();
    EXPECT_FALSE(towns::check_furniture(town)[spawn_points].passed()) << "there are none";
    town.spawn_points = {spawn(town, "west_in_1", 20)};
    EXPECT_TRUE(towns::check_furniture(town)[spawn_points].passed());

    for (const auto& spoil : std::vector<void (*)(world::SpawnPoint&)>{
             [](world::SpawnPoint& point) { point.mutate_s(30); },
             [](world::SpawnPoint& point) { point.mutate_s(-1); },
             [](world::SpawnPoint& point) { point.mutate_lane(1000); },
             [](world::SpawnPoint& point) { point.mutate_for_walkers(true); },
             [](world::SpawnPoint& point) {
                 point.mutable_position() = world::Vec3(20, -1.75, 3);
             }}) {
        town.spawn_points = {spawn(town, "west_in_1", 20)};
        spoil(town.spawn_points[0]);
        EXPECT_EQ(towns::check_furniture(town)[spawn_points].figure, 1);
    }
}

TEST(FurnitureCheck, FindsWhatStandsOnALane) {
    TownT town = test::t_junction();
    town.buildings = {house(20, 14)};
    EXPECT_TRUE(towns::check_furniture(town)[ways].passed());
    // Its southern face comes down to y = 1: 0.75 m from the lane at 1.75 m.
    town.buildings = {house(20, 6.5)};
    const Criterion wall = towns::check_furniture(town)[ways];
    ASSERT_FALSE(wall.passed());
    EXPECT_EQ(wall.worst[0].name, "building 0 on west_out_0");
    town.spawn_points = {spawn(town, "west_out_1", 20)};
    EXPECT_EQ(towns::check_furniture(town)[spawn_points].figure, 1);
}

/// Where no lane is, nor a sidewalk's middle: only a long vehicle comes there.
TEST(FurnitureCheck, FindsWhatABusSweepsAwayInABend) {
    TownT town = test::straight_road();
    EXPECT_TRUE(ground::bus_bodies(town).empty()) << "straight on it stays in its lane";
    world::LaneT& lane = town.lanes[at(town, "east_1")];
    lane.centre = {{0, 0, 0}, {60, 0, 0}, {60, 60, 0}};
    lane.length = 120;
    ASSERT_TRUE(towns::check_furniture(town)[bends].passed());
    const std::vector<ground::SweptBody> bodies = ground::bus_bodies(town);
    ASSERT_FALSE(bodies.empty());
    const ground::SweptBody& body = bodies[bodies.size() / 2];
    const auto place = [&](double inwards) {
        const Eigen::Vector2d corner = body.corners(inwards)[0];
        world::Prop pole;
        pole.mutate_kind(world::PropKind::street_light);
        pole.mutate_height(7);
        pole.mutable_position() = world::Vec3(corner.x(), corner.y(), body.z);
        town.props = {pole};
        return towns::check_furniture(town)[bends];
    };
    const Criterion swept = place(0.3);
    EXPECT_EQ(swept.figure, 1);
    EXPECT_EQ(swept.worst[0].name, "street_light 0");
    town.props[0].mutable_position() =
        world::Vec3(town.props[0].position().x(), town.props[0].position().y(), body.z - 8);
    EXPECT_TRUE(towns::check_furniture(town)[bends].passed()) << "a storey below";
    // A fence through a body: neither's corner is in the other one.
    world::Prop fence;
    fence.mutate_kind(world::PropKind::fence);
    fence.mutate_length(40);
    fence.mutate_width(0.1F);
    fence.mutate_height(1);
    fence.mutate_yaw(static_cast<float>(body.yaw + M_PI / 2));
    fence.mutable_position() = world::Vec3(body.centre.x(), body.centre.y(), body.z);
    town.props = {fence};
    EXPECT_EQ(towns::check_furniture(town)[bends].figure, 1);
    town.buildings = {house(body.centre.x(), body.centre.y())};
    EXPECT_EQ(towns::check_furniture(town)[bends].figure, 2) << "a house in the middle of it";
    town.buildings.clear();
    EXPECT_TRUE(place(-40).passed());
}

TEST(FurnitureCheck, LetsPolesStandAtTheEdgeOfASidewalk) {
    TownT town = test::t_junction();
    world::Prop pole;
    pole.mutate_kind(world::PropKind::street_light);
    pole.mutate_length(3);  // its arm
    pole.mutate_height(7);
    pole.mutable_position() = world::Vec3(20, 4.0, 0);
    town.props = {pole};
    EXPECT_TRUE(towns::check_furniture(town)[ways].passed());
    town.props[0].mutable_position() = world::Vec3(20, 4.5, 0);
    EXPECT_FALSE(towns::check_furniture(town)[ways].passed())
        << "0.25 m from the sidewalk's middle";
}

TEST(FurnitureCheck, LetsThingsStandUnderABridge) {
    TownT town = test::bridge();
    town.buildings = {house(0, 12)};
    town.buildings[0].mutate_height(4);
    EXPECT_TRUE(towns::check_furniture(town)[ways].passed());
    town.buildings[0].mutate_height(8);
    EXPECT_FALSE(towns::check_furniture(town)[ways].passed());
}

}  // namespace
}  // namespace reprise
