#include "ground/mesh/level_paths.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/support/places.h"
#include "towns/check/ground_check.h"
#include "world/town.h"

namespace reprise {
namespace {

using world::LaneKind;
using world::TownT;

/// Two paths cross in the middle of a junction, one of them `higher` by this.
TownT crossing_paths(double higher) {
    TownT town;
    town.name = "crossing";
    town.lanes.push_back(test::lane(":j_0_0", LaneKind::internal, {{-15, 0, 0}, {15, 0, 0}}));
    town.lanes.push_back(
        test::lane(":j_1_0", LaneKind::internal, {{0, -15, higher}, {0, 15, higher}}));
    town.junctions.resize(1);
    for (world::LaneT& lane : town.lanes)
        lane.junction = 0;
    town.low = world::Vec3(-20, -20, 0);
    town.high = world::Vec3(20, 20, 0);
    return town;
}

double height_in_the_middle(const TownT& town, std::size_t lane) {
    const world::LaneProjection at = world::project(town.lanes[lane], {0, 0, 0});
    return world::point_at(town.lanes[lane], at.s).position.z();
}

TEST(LevelPaths, MakesCrossingPathsMeet) {
    TownT town = crossing_paths(0.2);
    ground::level_paths(town);
    EXPECT_NEAR(height_in_the_middle(town, 0), height_in_the_middle(town, 1), 0.01);
    EXPECT_NEAR(height_in_the_middle(town, 0), 0.1, 0.02);
}

TEST(LevelPaths, LeavesTheEndsWithoutAStepOrAKink) {
    TownT town = crossing_paths(0.2);
    ground::level_paths(town);
    for (std::size_t lane = 0; lane < 2; ++lane) {
        const auto& centre = town.lanes[lane].centre;
        EXPECT_EQ(centre.front().z(), lane == 0 ? 0.0 : 0.2);
        EXPECT_EQ(centre.back().z(), lane == 0 ? 0.0 : 0.2);
        for (std::size_t i = 1; i < centre.size(); ++i)
            EXPECT_LT(std::abs(centre[i].z() - centre[i - 1].z()), 0.03) << "steep at " << i;
        EXPECT_LT(std::abs(centre[1].z() - centre[0].z()), 0.01);
    }
}

TEST(LevelPaths, LetsOneSurfaceCarryBoth) {
    for (const bool levelled : {false, true}) {
        TownT town = crossing_paths(0.2);
        if (levelled)
            ground::level_paths(town);
        const auto criteria = towns::check_ground(town, ground::build_ground(town));
        EXPECT_EQ(criteria[0].passed(), levelled) << criteria[0].name << ' ' << criteria[0].figure;
    }
}

TEST(LevelPaths, KeepsEveryBitWherePathsAgree) {
    for (const double slope : {0.0, 0.05}) {
        TownT town = test::t_junction(slope);
        const TownT before = town;
        ground::level_paths(town);
        EXPECT_EQ(town, before);
    }
}

TEST(LevelPaths, KeepsBridgesApart) {
    TownT town = crossing_paths(6);
    const TownT before = town;
    ground::level_paths(town);
    EXPECT_EQ(town, before);
}

TEST(LevelPaths, MovesPathsThatFollowEachOtherTogether) {
    // The second path ends in the middle, where a third one takes over.
    TownT town = crossing_paths(0.2);
    town.lanes[1].centre = {{0, -15, 0.2}, {0, 3, 0.2}};
    town.lanes.push_back(test::lane(":j_2_0", LaneKind::internal, {{0, 3, 0.2}, {0, 15, 0.2}}));
    town.lanes[2].junction = 0;
    ground::level_paths(town);
    EXPECT_EQ(town.lanes[1].centre.back(), town.lanes[2].centre.front());
    EXPECT_LT(town.lanes[1].centre.back().z(), 0.19);
}

}  // namespace
}  // namespace reprise
