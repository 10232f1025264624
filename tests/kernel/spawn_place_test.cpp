// Where a vehicle begins whose place is left to the seed.
#include <gtest/gtest.h>

#include "drivers/way/lane_graph.h"
#include "tests/kernel/whole_run.h"

namespace reprise::test {

TEST(SpawnPlace, LeftToTheSeedIsNotOnTheWayOutOfTheMap) {
    world::Recording recording =
        in_town("town1", "spawn{ model = 'sedan', driver = 'autopilot' } wait(9)", 0.05);
    // Behind the next junction many a road ends now.
    auto& lanes = recording.town.lanes;
    for (std::size_t i = 0; i < lanes.size(); i += 3)
        if (lanes[i].kind == world::LaneKind::driving)
            for (const world::Link& link : lanes[i].links)
                lanes[link.to()].links.clear();
    const drivers::LaneGraph graph(recording.town);
    int ways_out = 0;
    for (std::uint32_t i = 0; i < lanes.size(); ++i) {
        const world::LaneT& lane = lanes[i];
        ways_out += lane.kind == world::LaneKind::driving && lane.length >= 30 &&
                            !lane.links.empty() && !graph.goes_on(i)
                        ? 1
                        : 0;
    }
    ASSERT_GT(ways_out, 3);
    for (unsigned seed = 1; seed <= 20; ++seed) {
        recording.episode.seed = seed;
        const auto ticks = run(recording);
        const world::TickView tick = ticks.at(0).recorded().view;
        ASSERT_EQ(tick.measurements().size(), 1u);
        EXPECT_TRUE(graph.goes_on(tick.measurements()[0].lane())) << "seed " << seed;
    }
}

}  // namespace reprise::test
