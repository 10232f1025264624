#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/tick.h"

namespace reprise::test {
namespace {

const std::string street = R"(
    spawn{ name = 'ego', model = 'taxi', driver = 'autopilot' }
    spawn{ model = 'van', driver = 'traffic' }
    local lane = pick_lane{ sidewalk = true, length = 20 }
    spawn{ model = 'runner', lane = lane, s = 5 }
    spawn{ model = 'nun', lane = lane, s = 8 }
    wait(60))";

/// Who is there, each with the look that its seed and id give, sorted.
template <typename Actor>
void expect_looks(std::span<const Actor> actors,
                  std::span<const world::Look> looks,
                  std::uint64_t seed) {
    ASSERT_EQ(actors.size(), looks.size());
    for (std::size_t i = 0; i < actors.size(); ++i) {
        EXPECT_EQ(looks[i].actor(), actors[i].id());
        EXPECT_EQ(looks[i].look(), world::drawn_look(seed, actors[i].id()).look());
    }
}

TEST(Looks, AreRecordedForEverybodyAsDrawn) {
    const world::Recording recording = in_town1(street, 12, 0.5);
    const std::uint64_t seed = recording.episode.seed;
    std::size_t seen = 0;
    for (const KeptTick& kept : run(recording)) {
        const world::TickView tick = kept.recorded().view;
        expect_looks(tick.vehicles(), tick.vehicle_looks(), seed);
        expect_looks(tick.cars(), tick.car_looks(), seed);
        for (const world::WalkerState& walker : tick.walkers())
            EXPECT_EQ(walker.look(), world::drawn_look(seed, walker.id()).look());
        seen += tick.vehicles().size() + tick.cars().size() + tick.walkers().size();
    }
    EXPECT_GT(seen, 100U);
}

TEST(Looks, ChangeWithTheSeedAndNotWithTheRun) {
    world::Recording recording = in_town1(street, 12, 0.2);
    const auto first = run(recording);
    const auto second = run(recording);
    ASSERT_EQ(first.size(), second.size());
    const world::TickView one = first.back().recorded().view;
    const world::TickView same = second.back().recorded().view;
    EXPECT_EQ(one.tick->digests()->chain(), same.tick->digests()->chain());
    recording.episode.seed += 1;
    const auto other = run(recording);
    const std::uint32_t id = one.vehicles().front().id();
    EXPECT_NE(world::find(one.vehicle_looks(), id)->look(),
              world::find(other.back().recorded().view.vehicle_looks(), id)->look());
}

}  // namespace
}  // namespace reprise::test
