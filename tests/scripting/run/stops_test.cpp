#include "scripting/run/stops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "tests/support/places.h"
#include "world/units.h"

namespace reprise::scripting {

namespace {

using testing::ElementsAre;
using world::Turn;

/// Two lanes east, `in`, up to a junction: from the right one on to the right one of `east` or
/// south, from the left one on to the left one of `east` or north. From the left one of `east` one
/// gets to `far`.
enum Lane : std::uint32_t { east_1, east_2, far_1, in_1, in_2, north_1, south_1 };

world::TownT crossroads() {
    const auto road = [](const char* name, double x, double y, double to_x, double to_y) {
        return test::lane(
            name, world::LaneKind::driving, {world::Vec3(x, y, 0), world::Vec3(to_x, to_y, 0)});
    };
    world::TownT town;
    town.name = "crossroads";
    town.lanes = {road("east_1", 320, -5, 620, -5),  // by name, as in every town
                  road("east_2", 320, -2, 620, -2),
                  road("far_1", 640, -2, 900, -2),
                  road("in_1", 0, -5, 300, -5),
                  road("in_2", 0, -2, 300, -2),
                  road("north_1", 312, 10, 312, 300),
                  road("south_1", 308, -15, 308, -300)};
    for (const std::uint32_t right : {in_1, east_1}) {
        town.lanes[right].left = right + 1;
        town.lanes[right + 1].right = right;
    }
    const auto link = [&](std::uint32_t from, std::uint32_t to, Turn turn) {
        const world::Vec3 begin = town.lanes[from].centre.back();
        const world::Vec3 end = town.lanes[to].centre.front();
        const auto via = static_cast<std::uint32_t>(town.lanes.size());
        town.lanes.push_back(
            test::lane("via_" + std::to_string(via), world::LaneKind::internal, {begin, end}));
        town.lanes[via].links = {world::Link(to, world::none, world::none, turn, false, 0)};
        town.lanes[from].links.emplace_back(to, via, world::none, turn, false, std::uint16_t{0});
    };
    link(in_1, east_1, Turn::straight);
    link(in_1, south_1, Turn::right);
    link(in_2, east_2, Turn::straight);
    link(in_2, north_1, Turn::left);
    link(east_2, far_1, Turn::straight);
    return town;
}

std::vector<std::uint32_t> chosen(std::optional<world::LanePlace> here,
                                  const std::vector<std::string>& names,
                                  world::LaneChanges changes = world::LaneChanges::allowed) {
    const world::TownT town = crossroads();
    std::vector<StopLanes> stops;
    for (const std::string& name : names)
        stops.push_back(stop_named(town, name));
    return choose_lanes(town, world::Planner(town, changes), here, stops);
}

}  // namespace

TEST(Stops, AnEdgeIsAnyOfItsLanesForCars) {
    const world::TownT road = test::straight_road(400, 3);
    EXPECT_THAT(stop_named(road, "east"), ElementsAre(1, 2, 3)) << "0 is the sidewalk";
    EXPECT_THAT(stop_named(road, "east_2"), ElementsAre(2));
}

TEST(Stops, WhoIsOnALaneOfTheEdgeStaysOnIt) {
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"in"}), ElementsAre(in_2));
    EXPECT_THAT(chosen(world::LanePlace{in_1, 20}, {"in"}), ElementsAre(in_1));
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"in", "east"}), ElementsAre(in_2, east_2));
}

TEST(Stops, AreLanesFromWhichTheNextOneCanBeReached) {
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"east", "far"}), ElementsAre(east_2, far_1));
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"in", "north"}), ElementsAre(in_2, north_1));
    EXPECT_THAT(chosen(world::LanePlace{in_1, 20}, {"in", "south"}), ElementsAre(in_1, south_1));
    EXPECT_THAT(chosen(std::nullopt, {"in", "east", "far"}), ElementsAre(in_2, east_2, far_1));
    const auto none = world::LaneChanges::forbidden;
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"east"}, none), ElementsAre(east_2));
}

TEST(Stops, ALaneThatIsNamedIsMeant) {
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"east_1"}), ElementsAre(east_1));
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"east_1", "far"}), ElementsAre(east_1, far_1));
}

TEST(Stops, WhereNoWayLeadsAreTheRightmostLanes) {
    EXPECT_THAT(chosen(world::LanePlace{in_2, 20}, {"north", "east"}),
                ElementsAre(north_1, east_1));
}

/// Tries all.
TEST(Stops, CostAsLittleAsAnyOthers) {
    const world::TownT town = crossroads();
    const world::Planner planner(town);
    const auto cost = [&](world::LanePlace here, const std::vector<std::uint32_t>& lanes) {
        double sum = 0;
        for (const std::uint32_t lane : lanes) {
            const double length = town.lanes[lane].length;
            sum += planner.cost(here, {lane, length}).value_or(world::infinity) - length;
            here = {lane, 0};
        }
        return sum;
    };
    for (const std::uint32_t from : {in_1, in_2})
        for (const double s : {0.0, 100.0, 270.0, 295.0}) {
            const world::LanePlace here{from, s};
            const double best = cost(here, chosen(here, {"in", "east", "far"}));
            for (const std::uint32_t first : {in_1, in_2})
                for (const std::uint32_t second : {east_1, east_2})
                    EXPECT_LE(best, cost(here, {first, second, far_1}) + 1e-9)
                        << from << ' ' << s << ' ' << first << ' ' << second;
        }
}

TEST(SetRoute, OfAnEdgeKeepsTheLaneThatServes) {
    test::Stage stage(test::running(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_2', s = 50 }
        wait_ticks(1)
        ego:set_route{ 'east' })"));
    stage.play(3);
    std::vector<std::vector<std::uint32_t>> routes;
    for (const auto& command : stage.commands)
        if (command.kind == world::CommandKind::set_route)
            routes.push_back(command.lanes);
    EXPECT_THAT(routes, ElementsAre(ElementsAre(2)));
}

}  // namespace reprise::scripting
