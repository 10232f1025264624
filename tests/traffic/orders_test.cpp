#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "world/check.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::command;
using test::lane;
using test::own_town;
using test::spawn;
using test::Stage;
using world::CommandKind;

constexpr std::uint32_t actor = 3;

world::CommandT set_speed(double speed, double duration) {
    world::CommandT order = command(CommandKind::set_speed, actor);
    order.speed = speed;
    order.duration = duration;
    return order;
}

TEST(Orders, ASpawnedCarStandsWhereItWasPut) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "l1_b1_2");
    Stage stage(loaded, 0);
    const world::TickDraft& tick = stage.step({spawn(actor, road, 50, 10)});
    const world::CarState* car = stage.car(actor);
    ASSERT_NE(car, nullptr);
    // The origin was put at s = 50; one step of 10 m/s has passed.
    const world::LanePoint at = world::point_at(loaded.town.lanes[road], 50 + 10 * 0.05);
    EXPECT_NEAR(car->position().x(), at.position.x(), 0.02);
    EXPECT_NEAR(car->position().y(), at.position.y(), 0.02);
    EXPECT_NEAR(static_cast<double>(car->yaw()), at.yaw, 0.01);
    EXPECT_NEAR(static_cast<double>(car->speed()), 10, 0.2);
    EXPECT_EQ(car->lane(), road);
    ASSERT_EQ(tick.tick.events.size(), 1U);
    EXPECT_EQ(tick.tick.events[0].kind, world::EventKind::spawned);
    EXPECT_EQ(tick.tick.events[0].text, "car3");
    EXPECT_EQ(tick.tick.events[0].line, 12U);
}

TEST(Orders, SpeedsAreReachedInTheTimeGivenAndHeld) {
    const auto& loaded = own_town("town1");
    Stage stage(loaded, 0);
    stage.step({spawn(actor, lane(loaded.town, "t1_l1_1"), 5, 10)});
    stage.step({set_speed(4, 2.0)});
    stage.steps(19);
    EXPECT_NEAR(static_cast<double>(stage.car(actor)->speed()), 7, 0.1) << "half-way";
    stage.steps(20);
    EXPECT_NEAR(static_cast<double>(stage.car(actor)->speed()), 4, 0.01);
    stage.steps(60);
    EXPECT_NEAR(static_cast<double>(stage.car(actor)->speed()), 4, 0.01) << "held";
    stage.step({command(CommandKind::free_speed, actor)});
    stage.steps(80);
    EXPECT_GT(stage.car(actor)->speed(), 8.0F) << "SUMO drives again";
}

TEST(Orders, AtOnceIsAsFastAsACarCan) {
    const auto& loaded = own_town("town1");
    Stage stage(loaded, 0);
    stage.step({spawn(actor, lane(loaded.town, "t1_l1_1"), 5, 13.5)});
    stage.step({set_speed(0, 0)});
    int ticks = 1;
    while (stage.car(actor)->speed() > 0.0F && ticks < 200) {
        EXPECT_GE(stage.car(actor)->acceleration(), -10.5F);
        stage.step();
        ++ticks;
    }
    EXPECT_NEAR(ticks * 0.05, 13.5 / 9, 0.2);
}

TEST(Orders, AnOrderedSpeedDoesNotRunIntoOthers) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "t1_l1_1");
    const world::VehicleState standing = test::vehicle_on(loaded.town.lanes[road], 1, 90);
    Stage stage(loaded, 0);
    stage.step({}, {standing});
    stage.step({spawn(actor, road, 5, 10)}, {standing});
    stage.step({set_speed(20, 0)}, {standing});
    for (int i = 0; i < 300; ++i)
        stage.step({}, {standing});
    EXPECT_LT(stage.car(actor)->speed(), 0.01F);
    EXPECT_LT(stage.car(actor)->lane_s(), 90.0F - 1.0F);
}

TEST(Orders, LaneChangesHappenAndLast) {
    const auto& loaded = own_town("town1");
    const std::uint32_t left = lane(loaded.town, "t1_l1_2");
    const std::uint32_t right = lane(loaded.town, "t1_l1_1");
    Stage stage(loaded, 0);
    stage.step({spawn(actor, left, 5, 10)});
    stage.steps(40);
    EXPECT_EQ(stage.car(actor)->lane(), left) << "no change of its own accord";
    world::CommandT order = command(CommandKind::change_lane, actor);
    order.lanes = {right};
    order.duration = 2;
    stage.step({order});
    stage.steps(4);
    const double y = stage.car(actor)->position().y();
    EXPECT_NE(stage.car(actor)->lamps() & world::lamp_right, 0) << "it indicates";
    stage.steps(45);
    ASSERT_EQ(stage.car(actor)->lane(), right);
    const Eigen::Vector3d p(stage.car(actor)->position().x(), stage.car(actor)->position().y(), 0);
    EXPECT_NEAR(world::project(loaded.town.lanes[right], p).t, 0, 0.15) << y;
    stage.steps(40);
    EXPECT_EQ(stage.car(actor)->lane(), right) << "it stays";
}

TEST(Orders, ACutInInFrontOfTheEgoIsMade) {
    const auto& loaded = own_town("town1");
    const std::uint32_t left = lane(loaded.town, "t1_l1_2");
    const std::uint32_t right = lane(loaded.town, "t1_l1_1");
    Stage stage(loaded, 0);
    double s = 20;
    auto ego = [&] { return test::vehicle_on(loaded.town.lanes[right], 1, s += 0.5, 10); };
    stage.step({}, {ego()});
    stage.step({spawn(actor, left, s + 9, 10)}, {ego()});
    stage.step({set_speed(10, 0)}, {ego()});
    world::CommandT order = command(CommandKind::change_lane, actor);
    order.lanes = {right};
    order.duration = 1.5;
    stage.step({order}, {ego()});
    for (int i = 0; i < 50; ++i)
        stage.step({}, {ego()});
    EXPECT_EQ(stage.car(actor)->lane(), right) << "4 m in front of the ego's bumper, as told";
}

TEST(Orders, RoutesAreFollowed) {
    const auto& loaded = own_town("town1");
    Stage stage(loaded, 0);
    stage.step({spawn(actor, lane(loaded.town, "a1_a2_1"), 10, 8)});
    world::CommandT order = command(CommandKind::set_route, actor);
    const std::uint32_t target = lane(loaded.town, "l1_t1_1");
    order.lanes = {lane(loaded.town, "a2_l1_1"), target};
    stage.step({order});
    bool passed = false;
    for (int i = 0; i < 1200 && !passed; ++i) {
        stage.step();
        ASSERT_NE(stage.car(actor), nullptr);
        passed = loaded.town.lanes[stage.car(actor)->lane()].edge == "l1_t1";
    }
    EXPECT_TRUE(passed);
}

TEST(Orders, ARouteThatIsToldInsideAJunctionGoesOnFromWhereThatComesOut) {
    const auto& loaded = own_town("town1");
    int told = 0;
    for (const char* name : {"a2_a1_1", "a2_a3_1", "a2_l1_1"}) {
        Stage stage(loaded, 0);
        stage.step({spawn(actor, lane(loaded.town, "a1_a2_1"), 40, 8)});
        const auto edge = [&] { return loaded.town.lanes[stage.car(actor)->lane()].edge; };
        for (int i = 0; i < 1200 && edge() == "a1_a2"; ++i)
            stage.step();
        ASSERT_EQ(edge().front(), ':') << edge();
        world::CommandT order = command(CommandKind::set_route, actor);
        order.lanes = {lane(loaded.town, name)};
        stage.step({order});
        const std::string wanted = loaded.town.lanes[order.lanes.front()].edge;
        for (int i = 0; i < 6000 && edge() != wanted; ++i) {
            stage.step();
            ASSERT_NE(stage.car(actor), nullptr);
        }
        EXPECT_EQ(edge(), wanted);
        ++told;
    }
    EXPECT_EQ(told, 3);
}

TEST(Orders, ParkedCarsStandAndAreRecordedEveryTick) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "a1_a2_1");
    Stage stage(loaded, 40);
    stage.step({spawn(actor, road, 20, 0, world::Driver::parked, -2.6)});
    ASSERT_NE(stage.car(actor), nullptr);
    const world::CarState first = *stage.car(actor);
    const world::LanePoint at = world::point_at(loaded.town.lanes[road], 20);
    const Eigen::Vector3d right(std::sin(at.yaw), -std::cos(at.yaw), 0);
    EXPECT_NEAR(first.position().x(), at.position.x() + 2.6 * right.x(), 1e-3);
    EXPECT_NEAR(first.position().y(), at.position.y() + 2.6 * right.y(), 1e-3);
    stage.steps(100);
    EXPECT_EQ(*stage.car(actor), first);
    stage.step({command(CommandKind::despawn, actor)});
    EXPECT_EQ(stage.car(actor), nullptr);
    EXPECT_EQ(stage.draft().traffic.cars.size(), 40U);
}

TEST(Orders, TrafficStopsBehindACarParkedOnTheLaneAndPassesOneBesideIt) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "t1_l1_1");
    for (const double offset : {0.0, -2.6}) {
        Stage stage(loaded, 0);
        stage.step(
            {spawn(1, road, 80, 0, world::Driver::parked, offset), spawn(actor, road, 10, 10)});
        stage.steps(300);
        ASSERT_NE(stage.car(actor), nullptr);
        const bool stopped = stage.car(actor)->lane() == road && stage.car(actor)->lane_s() < 80 &&
                             stage.car(actor)->speed() < 0.01F;
        EXPECT_EQ(stopped, offset == 0.0) << offset;
    }
}

TEST(Orders, APlaceIsFoundForWhoHasNone) {
    const auto& loaded = own_town("town1");
    std::vector<world::Vec3> places;
    for (const std::uint64_t seed : {1U, 2U, 1U}) {
        Stage stage(loaded, 100, seed);
        stage.step({spawn(actor, world::none, 0, 0)});
        ASSERT_NE(stage.car(actor), nullptr);
        places.push_back(stage.car(actor)->position());
    }
    EXPECT_EQ(places[0], places[2]);
    EXPECT_NE(places[0], places[1]);
}

TEST(Orders, BackgroundCarsGiveWayToASpawn) {
    const auto& loaded = own_town("town2");
    const std::uint32_t road = lane(loaded.town, "t1_l1_1");
    Stage stage(loaded, 60);
    stage.steps(100);
    stage.step({spawn(actor, road, 60, 0)});
    const world::CarState* car = stage.car(actor);
    ASSERT_NE(car, nullptr);
    EXPECT_EQ(stage.draft().traffic.cars.size(), 61U);
    for (const world::CarState& other : stage.draft().traffic.cars)
        if (other.id() != actor && other.lane() == road) {
            EXPECT_GT(std::hypot(other.position().x() - car->position().x(),
                                 other.position().y() - car->position().y()),
                      4);
        }
}

TEST(Orders, OthersActorsAreLeftAlone) {
    Stage stage(own_town("town2"), 3);
    world::CommandT foreign = command(CommandKind::set_speed, 99);
    EXPECT_NO_THROW(stage.step({spawn(1, 0, 0, 0, world::Driver::walker),
                                spawn(2, 0, 0, 0, world::Driver::manual),
                                foreign,
                                command(CommandKind::despawn, 99),
                                command(CommandKind::walk, 1),
                                command(CommandKind::finish, 0)}));
    EXPECT_EQ(stage.draft().traffic.cars.size(), 3U);
}

TEST(Orders, ASpawnOnASidewalkIsTheScenariosMistake) {
    const auto& loaded = own_town("town2");
    Stage stage(loaded, 0);
    try {
        stage.step({spawn(actor, lane(loaded.town, "t1_l1_0"), 10)});
        FAIL();
    } catch (const world::Error& error) {
        EXPECT_STREQ(error.what(), "test.lua:12: spawn: lane 't1_l1_0' is not for cars");
    }
}

}  // namespace
}  // namespace reprise::traffic
