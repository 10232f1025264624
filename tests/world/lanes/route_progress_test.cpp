#include "world/lanes/route_progress.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::world {

namespace {

constexpr double front = 3.7;  // [m]

RouteProgress way(const TownT& town, LanePlace from, LanePlace to) {
    return RouteProgress(*Planner(town).plan(from, to));
}

}  // namespace

TEST(RouteProgress, IsTheShareOfTheWayThatWasDriven) {
    const TownT town = test::straight_road(400, 2);
    RouteProgress progress = way(town, {1, 100}, {1, 300});
    EXPECT_EQ(progress.share(), 0);
    progress.drive_on(town, LanePlace{1, 100}, 0, front);
    EXPECT_EQ(progress.share(), 0);
    for (int s = 110; s <= 200; s += 10)
        progress.drive_on(town, LanePlace{1, static_cast<double>(s)}, 10, front);
    EXPECT_DOUBLE_EQ(progress.share(), 0.5);
}

TEST(RouteProgress, IsOneOnceTheBumperIsAtTheGoal) {
    const TownT town = test::straight_road(400, 2);
    RouteProgress progress = way(town, {1, 100}, {1, 200});
    progress.drive_on(town, LanePlace{1, 196.2}, 96.2, front);
    EXPECT_DOUBLE_EQ(progress.share(), 0.962);
    progress.drive_on(town, LanePlace{1, 196.4}, 0.2, front);
    EXPECT_EQ(progress.share(), 1);
    progress.drive_on(town, std::nullopt, 50, front);
    EXPECT_EQ(progress.share(), 1) << "and stays so";
}

TEST(RouteProgress, NeverGoesBack) {
    const TownT town = test::straight_road(400, 2);
    RouteProgress progress = way(town, {1, 100}, {1, 300});
    progress.drive_on(town, LanePlace{1, 150}, 50, front);
    progress.drive_on(town, LanePlace{1, 120}, 30, front);
    EXPECT_DOUBLE_EQ(progress.share(), 0.25);
}

TEST(RouteProgress, CountsOnALaneBesideAndWhereLanesAreChanged) {
    const TownT town = test::straight_road(400, 2);
    RouteProgress progress = way(town, {1, 100}, {2, 300});
    for (int s = 110; s <= 250; s += 10)
        progress.drive_on(town, LanePlace{1, static_cast<double>(s)}, 10, front);
    EXPECT_DOUBLE_EQ(progress.share(), 0.75) << "it has not changed lanes yet";
    for (int s = 260; s <= 300; s += 10)
        progress.drive_on(town, LanePlace{2, static_cast<double>(s)}, 10, front);
    EXPECT_EQ(progress.share(), 1);
}

TEST(RouteProgress, StandsStillOffTheWay) {
    const TownT town = test::straight_road(400, 2);
    RouteProgress progress = way(town, {1, 100}, {1, 300});
    progress.drive_on(town, LanePlace{1, 150}, 50, front);
    for (int i = 0; i < 5; ++i)
        progress.drive_on(
            town, i % 2 == 0 ? std::optional(LanePlace{4, 200}) : std::nullopt, 5, front);
    EXPECT_DOUBLE_EQ(progress.share(), 0.25) << "on the other side of the road, and off it";
    progress.drive_on(town, LanePlace{1, 170}, 5, front);
    EXPECT_DOUBLE_EQ(progress.share(), 0.35);
}

TEST(RouteProgress, NobodyIsCarriedFartherThanItDrove) {
    const TownT town = test::straight_road(400, 2);
    RouteProgress progress = way(town, {1, 100}, {1, 300});
    progress.drive_on(town, LanePlace{1, 250}, 1, front);
    EXPECT_EQ(progress.share(), 0) << "put there";
}

TEST(PlanOver, PassesTheStopsInTheirOrder) {
    TownT town = test::straight_road(100, 1);  // east_1 leads into west_1 and back: a ring
    town.lanes[1].links.emplace_back(3U, none, none, Turn::around, false, std::uint16_t{0});
    town.lanes[3].links.emplace_back(1U, none, none, Turn::around, false, std::uint16_t{0});
    const Planner planner(town);
    const std::vector<std::uint32_t> once{3};
    const std::vector<std::uint32_t> about{3, 1, 3};
    const std::vector<std::uint32_t> from_here{1, 3};
    EXPECT_DOUBLE_EQ(plan_over(planner, {1, 40}, once, 50)->length, 60 + 50);
    EXPECT_DOUBLE_EQ(plan_over(planner, {1, 40}, about, 50)->length, 60 + 100 + 100 + 50);
    EXPECT_DOUBLE_EQ(plan_over(planner, {1, 40}, from_here, 50)->length, 60 + 50)
        << "the lane it stands on is passed";
}

TEST(RouteProgress, OfAWayThatPassesAStreetTwiceCountsBoth) {
    TownT town = test::straight_road(100, 1);
    town.lanes[1].links.emplace_back(3U, none, none, Turn::around, false, std::uint16_t{0});
    town.lanes[3].links.emplace_back(1U, none, none, Turn::around, false, std::uint16_t{0});
    const std::vector<std::uint32_t> about{3, 1, 3};
    RouteProgress progress(*plan_over(Planner(town), {1, 40}, about, 90));
    double driven = 0;
    for (double along = 40; along < 390; along += 2, driven += 2) {
        const auto lap = static_cast<std::uint32_t>(along / 100);
        progress.drive_on(town, LanePlace{lap % 2 == 0 ? 1U : 3U, along - lap * 100}, 2, front);
        if (along < 380) {
            EXPECT_NEAR(progress.share(), driven / 350, 1e-9) << along;
        }
    }
    EXPECT_EQ(progress.share(), 1);
}

}  // namespace reprise::world
