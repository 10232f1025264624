#include "remote/guide.h"

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "world/lanes/planner.h"
#include "world/tick.h"

namespace reprise::remote {
namespace {

constexpr std::uint32_t ego = 1;

const world::TownT& town1() {
    return test::own_town("town1").town;
}

/// A tick in which the vehicle is there; with `stops` the scenario says where to go as well.
world::SealedTick sealed(std::uint32_t lane,
                         double s,
                         const std::vector<std::uint32_t>& stops,
                         double goal_s) {
    world::TickDraft draft;
    draft.tick.index = 1;
    world::Measurement self;
    self.mutate_actor(ego);
    self.mutate_lane(lane);
    self.mutate_lane_s(s);
    draft.tick.measurements.push_back(self);
    if (!stops.empty()) {
        world::CommandT command;
        command.kind = world::CommandKind::set_route;
        command.actor = ego;
        command.lanes = stops;
        command.s = goal_s;
        draft.tick.commands.push_back(command);
    }
    return world::seal(draft, {});
}

Guidance look(Guide& guide,
              std::uint32_t lane,
              double s,
              const std::vector<std::uint32_t>& stops = {},
              double goal_s = 0) {
    const world::SealedTick tick = sealed(lane, s, stops, goal_s);
    return guide.look(*tick.view().tick);
}

struct Way {
    std::vector<Turning> turnings;  ///< at junctions
    double largest_error = 0;       ///< [m] of the way to the goal, from what is left of the route
    Guidance last;
};

/// What is told along the route, driven in the middle of its lanes.
Way drive(Guide& guide, const world::Route& route, std::uint32_t goal, double goal_s) {
    Way way;
    bool first = true;
    Turning turning = Turning::follow_lane;
    for (const world::Route::Piece& piece : route.pieces)
        for (double s = piece.from; s < piece.to; s += 2) {
            way.last =
                first ? look(guide, piece.lane, s, {goal}, goal_s) : look(guide, piece.lane, s);
            first = false;
            const double left = route.length - (piece.start + s - piece.from);
            way.largest_error = std::max(way.largest_error, std::abs(way.last.way_to_goal - left));
            if (way.last.turning != turning && way.last.turning != Turning::follow_lane)
                way.turnings.push_back(way.last.turning);
            turning = way.last.turning;
        }
    return way;
}

struct Task {
    const char* start;
    double s;
    const char* goal;
    double goal_s;
    double length;  ///< [m]
    std::vector<Turning> turnings;
};

/// From scenarios/towns/town1/tasks.json.
TEST(Guide, TellsTheTurningsOfATaskAndHowFarItIs) {
    const auto straight = Turning::straight;
    const std::vector<Task> tasks{{"b3_c1_1", 46.4, "c2_c3_1", 11.5, 111.845, {straight, straight}},
                                  {"b3_b2_2", 25.3, "b1_l1_1", 81.8, 244.5, {straight, straight}},
                                  {"r1_t3_1", 226.8, "t3_t2_1", 51.6, 106.202, {straight}}};
    for (const Task& task : tasks) {
        const std::uint32_t goal = test::lane(town1(), task.goal);
        const auto route = world::Planner(town1()).plan({test::lane(town1(), task.start), task.s},
                                                        {goal, task.goal_s});
        ASSERT_TRUE(route);
        Guide guide(town1(), ego);
        const Way way = drive(guide, *route, goal, task.goal_s);
        EXPECT_NEAR(route->length, task.length, 0.01);
        EXPECT_EQ(way.turnings, task.turnings) << task.start;
        EXPECT_LT(way.largest_error, 0.01) << task.start;
        EXPECT_LT(way.last.way_to_goal, 2.01);
    }
}

TEST(Guide, WithoutAGoalThereIsNoTurning) {
    Guide guide(town1(), ego);
    const Guidance said = look(guide, test::lane(town1(), "b1_b2_1"), 30);
    EXPECT_EQ(said.turning, Turning::none);
    EXPECT_EQ(said.way_to_goal, 0);
}

TEST(Guide, ATurnAtWhichTheVehicleWentElsewhereIsPlannedAnew) {
    Guide guide(town1(), ego);
    const std::uint32_t goal = test::lane(town1(), "b2_b3_2");
    look(guide, test::lane(town1(), "b1_b2_1"), 30, {goal}, 30);
    const std::uint32_t elsewhere = test::lane(town1(), "c2_c3_1");
    const Guidance said = look(guide, elsewhere, 5);
    const auto route = world::Planner(town1()).plan({elsewhere, 5}, {goal, 30});
    EXPECT_NEAR(said.way_to_goal, route->length, 0.01);
}

TEST(Guide, OffEveryLaneTheLastWordStays) {
    Guide guide(town1(), ego);
    const Guidance before =
        look(guide, test::lane(town1(), "b1_b2_1"), 30, {test::lane(town1(), "b1_b2_1")}, 60);
    const Guidance off = look(guide, world::none, 0);
    EXPECT_NEAR(before.way_to_goal, 30, 0.01);
    EXPECT_EQ(off.way_to_goal, before.way_to_goal);
}

TEST(Guide, TheWayLeadsThroughTheStopsAndTheyArePassedOnce) {
    const std::uint32_t first = test::lane(town1(), "b1_b2_1");
    const std::uint32_t stop = test::lane(town1(), "c2_c3_1");
    const std::uint32_t goal = test::lane(town1(), "b2_b3_2");
    const world::Planner planner(town1());
    const double direct = planner.plan({first, 30}, {goal, 30})->length;
    const double through =
        planner.plan({first, 30}, {stop, 0})->length + planner.plan({stop, 0}, {goal, 30})->length;
    Guide guide(town1(), ego);
    EXPECT_NEAR(look(guide, first, 30, {stop, goal}, 30).way_to_goal, through, 0.01);
    EXPECT_GT(through, direct + 1);
    // Behind the stop, off the way: only the goal is left.
    look(guide, stop, 5);
    EXPECT_NEAR(look(guide, first, 30).way_to_goal, direct, 0.01);
}

TEST(Guide, WhoDrivesPastItsGoalIsToldTheWayBackToIt) {
    const std::uint32_t first = test::lane(town1(), "b1_b2_1");
    const std::uint32_t goal = test::lane(town1(), "b2_b3_2");
    const double way = world::Planner(town1()).plan({first, 30}, {goal, 30})->length;
    Guide guide(town1(), ego);
    look(guide, first, 30, {goal}, 30);
    EXPECT_NEAR(look(guide, goal, 5).way_to_goal, 25, 0.01);
    EXPECT_NEAR(look(guide, first, 30).way_to_goal, way, 0.01);
}

TEST(Guide, ANewWordOfTheScenarioIsTheWholeWay) {
    const std::uint32_t first = test::lane(town1(), "b1_b2_1");
    const std::uint32_t stop = test::lane(town1(), "c2_c3_1");
    const std::uint32_t goal = test::lane(town1(), "b2_b3_2");
    Guide fresh(town1(), ego), told_before(town1(), ego);
    look(told_before, first, 30, {stop, goal}, 30);
    look(told_before, stop, 5);  // one stop was passed
    const Guidance wanted = look(fresh, first, 30, {stop, goal}, 60);
    const Guidance said = look(told_before, first, 30, {stop, goal}, 60);
    EXPECT_NEAR(said.way_to_goal, wanted.way_to_goal, 0.01);
    EXPECT_EQ(told_before.route_left()->lanes, (std::vector<std::uint32_t>{stop, goal}));
    const Guidance nearer = look(told_before, first, 30, {goal}, 30);
    EXPECT_NEAR(
        look(told_before, first, 30, {goal}, 60).way_to_goal, nearer.way_to_goal + 30, 0.01);
}

TEST(Guide, WhereAnotherOneIsToGoIsNoGoalOfOurs) {
    Guide guide(town1(), ego + 1);
    look(guide, test::lane(town1(), "b1_b2_1"), 30, {test::lane(town1(), "b2_b3_2")}, 30);
    EXPECT_FALSE(guide.route_left());
}

}  // namespace
}  // namespace reprise::remote
