#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/support/worlds.h"
#include "world/random.h"
#include "world/town.h"

namespace reprise {

namespace {

using world::LaneMap;
using world::TownT;

std::vector<std::string> names(const TownT& town, const std::vector<LaneMap::Found>& found) {
    std::vector<std::string> result;
    for (const LaneMap::Found& one : found)
        result.push_back(town.lanes[one.lane].name);
    return result;
}

using Names = std::vector<std::string>;

double uniform(std::uint64_t item, double low, double high) {
    return low + (high - low) * world::draw(1, 0, world::Purpose::scenario, item);
}

}  // namespace

TEST(LaneMap, FindsTheLaneUnderAPoint) {
    const TownT town = test::straight_road(400, 2);
    const LaneMap map(town);
    EXPECT_EQ(names(town, map.at({200, -1.0, 0})), Names{"east_2"});
    EXPECT_EQ(names(town, map.at({200, -5.0, 0})), Names{"east_1"});
    EXPECT_EQ(names(town, map.at({200, 1.0, 0})), Names{"west_2"});
    EXPECT_EQ(names(town, map.at({200, -8.0, 0})), Names{});
    EXPECT_EQ(names(town, map.at({401, -1.0, 0})), Names{});
    EXPECT_EQ(names(town, map.at({401, -1.0, 0}, 1.5)), (Names{"east_2", "west_2"}));
}

TEST(LaneMap, SaysWhereOnTheLane) {
    const TownT town = test::straight_road(400);
    const auto found = LaneMap(town).at({150, 1.25, 0.2});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_DOUBLE_EQ(found[0].at.s, 250);
    EXPECT_DOUBLE_EQ(found[0].at.t, 0.5);
}

TEST(LaneMap, TellsLevelsApart) {
    const TownT town = test::bridge();
    const LaneMap map(town);
    EXPECT_EQ(names(town, map.at({0, 0, 0.3})), Names{"below_0"});
    EXPECT_EQ(names(town, map.at({0, 0, 5.8})), Names{"over_0"});
}

TEST(LaneMap, FindsWhereOneWalks) {
    const TownT town = test::t_junction();
    const LaneMap map(town);
    EXPECT_EQ(names(town, map.walkable_at({20, -4.75, 0.15})), Names{"west_in_0"});
    EXPECT_EQ(names(town, map.walkable_at({50, -12.5, 0})), Names{":t_c0_0"});
    EXPECT_EQ(names(town, map.walkable_at({50, 5, 0.15})), Names{":t_w2_0"});
    EXPECT_EQ(names(town, map.walkable_at({50, 0, 0})), Names{});
    EXPECT_EQ(names(town, map.walkable_at({20, -4.75, 30})), Names{});
}

/// The second route: every lane, one by one, with project() alone.
TEST(LaneMap, AgreesWithLookingAtEveryLane) {
    const TownT town = test::t_junction();
    const LaneMap map(town);
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const Eigen::Vector3d p(uniform(2 * i, -5, 105), uniform(2 * i + 1, -65, 10), 0);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t lane = 0; lane < town.lanes.size(); ++lane) {
            if (!world::is_for_cars(town.lanes[lane]))
                continue;
            const auto at = world::project(town.lanes[lane], p);
            // Beyond a flat end the distance is more than the sideways part of it.
            const bool beside = std::abs(at.distance - std::abs(at.t)) < 1e-9;
            if (beside && std::abs(at.t) <= town.lanes[lane].width / 2)
                expected.push_back(lane);
        }
        std::vector<std::uint32_t> found;
        for (const LaneMap::Found& one : map.at(p))
            found.push_back(one.lane);
        ASSERT_EQ(found, expected) << p.transpose();
    }
}

TEST(LaneMap, AnswersTheSameAmongTheLanesNearSeveralPoints) {
    const TownT town = test::t_junction();
    const LaneMap map(town);
    const auto lanes_of = [](const std::vector<LaneMap::Found>& found) {
        std::vector<std::pair<std::uint32_t, double>> lanes;
        for (const LaneMap::Found& one : found)
            lanes.emplace_back(one.lane, one.at.s);
        return lanes;
    };
    std::size_t found = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const Eigen::Vector3d middle(uniform(4 * i, -5, 105), uniform(4 * i + 1, -65, 10), 0.1);
        const double angle = uniform(4 * i + 2, 0, 6.3);
        const double reach = uniform(4 * i + 3, 0, 6);
        const Eigen::Vector3d p =
            middle + reach * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
        const std::vector<std::uint32_t> near = map.near(middle, reach);
        ASSERT_EQ(lanes_of(map.at(p, near)), lanes_of(map.at(p))) << p.transpose();
        ASSERT_EQ(lanes_of(map.walkable_at(p, near)), lanes_of(map.walkable_at(p)))
            << p.transpose();
        found += map.at(p, near).size() + map.walkable_at(p, near).size();
    }
    EXPECT_GT(found, 500u);
}

TEST(LaneMap, PrefersTheLaneThatHeadsTheSameWay) {
    const TownT town = test::straight_road(400);
    const LaneMap map(town);
    const Eigen::Vector3d on_east(100, -1, 0);
    EXPECT_EQ(town.lanes[map.best(on_east, 0.1)->lane].name, "east_1");
    EXPECT_EQ(town.lanes[map.best(on_east, std::numbers::pi)->lane].name, "west_1");
    EXPECT_EQ(town.lanes[map.best(on_east, -std::numbers::pi)->lane].name, "west_1");
}

TEST(LaneMap, FindsNoLaneBeyondItsReach) {
    const TownT town = test::straight_road(400);
    const LaneMap map(town);
    EXPECT_FALSE(map.best({100, -50, 0}, 0));
    EXPECT_TRUE(map.best({100, -50, 0}, 0, 60));
    EXPECT_FALSE(map.best({-5000, 90000, 0}, 0, 60));
}

TEST(LaneMap, BreaksTiesByTheLowerIndex) {
    const TownT town = test::t_junction();
    // Two paths start at the same point in the same direction, or nearly.
    const auto found = LaneMap(town).best({40.0, -1.75, 0}, 0);
    ASSERT_TRUE(found);
    EXPECT_EQ(town.lanes[found->lane].name, ":t_0_0");
}

TEST(LaneMap, AnswersNothingWhereThereIsNothing) {
    const TownT empty;
    const LaneMap map(empty);
    EXPECT_TRUE(map.at({0, 0, 0}).empty());
    EXPECT_TRUE(map.walkable_at({0, 0, 0}).empty());
    EXPECT_FALSE(map.best({0, 0, 0}, 0));
    const TownT town = test::straight_road();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(LaneMap(town).at({nan, 0, 0}).empty());
    EXPECT_FALSE(LaneMap(town).best({nan, 0, 0}, 0));
}

}  // namespace reprise
