#include "drivers/road_view.h"

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"
#include "world/units.h"

namespace reprise::drivers {
namespace {

/// `count` times: a lane of 1 m, behind it two of 1 m beside each other that both lead to the next.
world::TownT ladder(std::uint32_t count) {
    world::TownT town;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double x = 2.0 * i + (k == 0 ? 0 : 1);
            town.lanes.push_back(test::make_lane("lane", test::Turtle(x, k, 0).ahead(1)));
        }
        const auto link = [](std::uint32_t to) {
            return test::make_link(to, world::none, world::Turn::straight);
        };
        town.lanes[3 * i].links = {link(3 * i + 1), link(3 * i + 2)};
        if (i + 1 < count)
            town.lanes[3 * i + 1].links = town.lanes[3 * i + 2].links = {link(3 * i + 3)};
    }
    return town;
}

}  // namespace

TEST(DistanceAlongLanes, IsFoundWhereShortLanesGiveMoreWaysThanOneCanTry) {
    const world::TownT town = ladder(60);  // 2^59 ways
    const LaneGraph graph(town);
    EXPECT_DOUBLE_EQ(distance_along_lanes(graph, 0, 0.25, 3 * 59, 0.5, 200), 118.25);
    EXPECT_EQ(distance_along_lanes(graph, 0, 0, 3 * 59, 0.5, 100), world::infinity);
    EXPECT_EQ(distance_along_lanes(graph, 3, 0, 0, 0.5, 200), world::infinity) << "back: never";
    EXPECT_DOUBLE_EQ(distance_along_lanes(graph, 0, 0.25, 0, 0.75, 200), 0.5);
    EXPECT_EQ(distance_along_lanes(graph, 0, 0.75, 0, 0.25, 200), world::infinity);
}

}  // namespace reprise::drivers
