#include "towns/buildings/buildings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/towns/sampled_town.h"
#include "towns/furnish/clearance.h"

namespace reprise::towns {
namespace {

using Eigen::Vector2d;
using test::any_road;
using test::AnyTown;
using test::foot_of;
using test::is_post;
using test::Lanes;
using test::points_of;
using world::LaneKind;
using world::LaneT;
using world::Loop;

class AnyBuildings : public AnyTown {};

INSTANTIATE_TEST_SUITE_P(Towns, AnyBuildings, test::any_town(), test::short_name);

TEST_P(AnyBuildings, BuildingsStandClearOfRoadsAndOfEachOther) {
    const Lanes roads(town(), any_road);
    std::map<std::pair<int, int>, std::vector<std::size_t>> cells;
    const auto cell = [](const world::Building& b, int x, int y) {
        return std::pair{static_cast<int>(std::floor(b.centre().x() / 50)) + x,
                         static_cast<int>(std::floor(b.centre().y() / 50)) + y};
    };
    for (std::size_t i = 0; i < town().buildings.size(); ++i)
        cells[cell(town().buildings[i], 0, 0)].push_back(i);
    for (std::size_t i = 0; i < town().buildings.size(); ++i) {
        const world::Building& one = town().buildings[i];
        for (const Vector2d& p : points_of(one, 1.5)) {
            ASSERT_GE(roads.border_distance(p), 0.39) << i;
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (const std::size_t k : cells[cell(one, x, y)]) {
                        const world::Building& b = town().buildings[k];
                        const Loop loop =
                            corners({world::in_plan(b.centre()), b.yaw(), b.length(), b.width()});
                        ASSERT_TRUE(k == i || !world::contains(loop, p)) << i << " and " << k;
                    }
        }
    }
}

TEST_P(AnyBuildings, FrontsFaceTheStreet) {
    const Lanes roads(town(), any_road);
    int along_streets = 0;
    int facing = 0;
    for (const world::Building& b : town().buildings) {
        const Vector2d to_back = Vector2d(-std::sin(b.yaw()), std::cos(b.yaw())) * (b.width() / 2);
        const double front = roads.border_distance(world::in_plan(b.centre()) - to_back);
        const double back = roads.border_distance(world::in_plan(b.centre()) + to_back);
        if (std::min(front, back) > 9)
            continue;
        ++along_streets;
        facing += front < back + 0.5 ? 1 : 0;
    }
    // A few stand between two streets and are nearer to the one behind.
    EXPECT_GE(facing, 0.93 * along_streets);
    EXPECT_GT(along_streets, 0);
}

TEST_P(AnyBuildings, SightTrianglesOfUnlitJunctionsAreFree) {
    for (const LaneT& lane : town().lanes) {
        const bool yields = std::any_of(lane.links.begin(),
                                        lane.links.end(),
                                        [](const world::Link& link) { return link.yields(); });
        if (lane.kind != LaneKind::driving || lane.junction == world::none || !yields ||
            town().junctions[lane.junction].lit)
            continue;
        const world::LanePoint end = world::point_at(lane, lane.length);
        const Vector2d kerb =
            end.position.head<2>() + Vector2d(-std::sin(end.yaw), std::cos(end.yaw)) *
                                         ((town().left_hand ? 0.5 : -0.5) * lane.width);
        const auto stands_off = [&](const Loop& points) {
            return std::all_of(points.begin(), points.end(), [&](const Vector2d& p) {
                return (p - kerb).norm() >= 8 - 1e-6;
            });
        };
        for (const world::Building& b : town().buildings)
            if ((world::in_plan(b.centre()) - kerb).norm() < 40) {
                ASSERT_TRUE(stands_off(points_of(b))) << lane.name;
            }
        for (const world::Prop& prop : town().props)
            if (!is_post(prop.kind()) && prop.height() > 1) {
                ASSERT_TRUE(stands_off(foot_of(prop))) << lane.name;
            }
        for (const world::Tree& tree : town().trees)
            if (tree.height() > 1) {
                ASSERT_TRUE(stands_off({world::in_plan(tree.position())})) << lane.name;
            }
    }
}

}  // namespace
}  // namespace reprise::towns
