#include "walkers/gate.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::walkers {
namespace {

using ground::Surface;

std::vector<Gate> gates_on(const std::vector<WalkMap::Step>& way) {
    const world::TownT town = test::straight_road();
    const world::LaneMap lanes(town);
    return gates_of(way, town, lanes, WalkerLights(town), RoadTraffic(town, lanes));
}

TEST(Gate, IsOneForAStraightWayOverTheRoad) {
    const std::vector<Gate> gates = gates_on({{{200, -10, 0}, Surface::sidewalk},
                                              {{200, -4, 0}, Surface::crossing},
                                              {{201, 0, 0}, Surface::crossing},
                                              {{200, 4, 0}, Surface::sidewalk},
                                              {{200, 10, 0}, Surface::sidewalk}});
    ASSERT_EQ(gates.size(), 1U);
    EXPECT_EQ(gates[0].first, 1U);
    EXPECT_EQ(gates[0].last, 3U);
    EXPECT_TRUE(gates[0].marked);
    EXPECT_EQ(gates[0].conflicts.size(), 2U);
}

TEST(Gate, OfTwoCrossingsThatMeetAtACornerHasEachItsOwn) {
    const std::vector<Gate> gates = gates_on({{{200, -10, 0}, Surface::sidewalk},
                                              {{200, -4, 0}, Surface::crossing},
                                              {{200, 4, 0}, Surface::crossing},
                                              {{208, 4, 0}, Surface::sidewalk},
                                              {{212, 4, 0}, Surface::sidewalk}});
    ASSERT_EQ(gates.size(), 2U);
    EXPECT_EQ(gates[0].first, 1U);
    EXPECT_EQ(gates[0].last, 2U);
    EXPECT_EQ(gates[0].conflicts.size(), 2U);
    EXPECT_EQ(gates[1].first, 2U);
    EXPECT_EQ(gates[1].last, 3U);
    EXPECT_TRUE(gates[1].conflicts.empty()) << "runs beside the road";
}

}  // namespace
}  // namespace reprise::walkers
