#include "drivers/way/way.h"

#include <gtest/gtest.h>

#include "tests/drivers/junction_road.h"

namespace reprise::drivers {
namespace {

/// From 50 m on the western lane of junction_road on.
class East {
  public:
    East() : town(test::junction_road(true)), graph(town), way(graph, 7, 1) {
        WayStart start;
        start.s = start.car_s = 50;
        way.restart({0}, start);
        way.extend(0, 1000);
    }

    world::TownT town;
    LaneGraph graph;
    Way way;
};

}  // namespace

TEST(Way, LeadsAlongTheLanesAndTheirLengthsAddUp) {
    const East east;
    EXPECT_EQ(east.way.lanes(), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_NEAR(east.way.path().end(), (200 - 50) + 10 + 200, 1e-9);
    EXPECT_TRUE(east.way.ended());
    for (const double s : {0.0, 77.3, 155.0, 300.0}) {
        EXPECT_NEAR(east.way.path().at(s).position.x(), 50 + s, 1e-6) << s;
        EXPECT_NEAR(east.way.path().at(s).position.y(), 0, 1e-9) << s;
    }
}

TEST(Way, HasAGateWhereItEntersTheJunction) {
    const East east;
    ASSERT_EQ(east.way.gates().size(), 1U);
    const Gate& gate = east.way.gates()[0];
    EXPECT_NEAR(gate.s, 150, 1e-9);
    EXPECT_NEAR(gate.exit_s, 160, 1e-9);
    EXPECT_EQ(gate.from, 0U);
    EXPECT_EQ(gate.to, 2U);
    EXPECT_TRUE(gate.yields);
}

TEST(Way, KnowsWhereTheCrossingLaneMeetsIt) {
    const East east;
    // The lanes cross at (205, 0): 155 m from where the path starts, 5 m into the junction for
    // both.
    ASSERT_EQ(east.way.gates().size(), 1U);
    ASSERT_EQ(east.way.gates()[0].conflicts.size(), 2U);
    for (const ConflictPoint& conflict : east.way.gates()[0].conflicts) {
        EXPECT_NEAR(conflict.our_s, 155, 0.01);
        EXPECT_NEAR(conflict.to_conflict, conflict.inside ? 5 : 205, 0.01);
        EXPECT_EQ(conflict.lane, conflict.inside ? 4U : 3U);
        EXPECT_TRUE(conflict.from_right);
    }
}

TEST(Way, DropsWhatLiesBehindAndCountsDistancesOn) {
    East east;
    const std::uint64_t before = east.way.plan_digest();
    east.way.drop_before(200, 10);
    EXPECT_EQ(east.way.lanes(), (std::vector<std::uint32_t>{2}));
    EXPECT_TRUE(east.way.gates().empty());
    EXPECT_NEAR(east.way.path().start(), 190, 1);
    EXPECT_NEAR(east.way.path().at(300).position.x(), 350, 1e-6);
    EXPECT_NE(east.way.plan_digest(), before);
}

}  // namespace reprise::drivers
