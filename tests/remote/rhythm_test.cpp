#include "remote/rhythm.h"

#include <vector>

#include <gtest/gtest.h>

namespace reprise::remote {
namespace {

constexpr double step = 0.05;  // [s]

Rhythm rhythm(unsigned every, std::uint64_t spawned, std::uint64_t sat_down) {
    world::CommandT spawn;
    spawn.duration = every * step;
    return Rhythm::of(spawn, spawned, sat_down, step);
}

std::vector<std::uint64_t> shown(const Rhythm& rhythm, std::uint64_t first, std::uint64_t last) {
    std::vector<std::uint64_t> ticks;
    for (std::uint64_t tick = first; tick <= last; ++tick)
        if (rhythm.shows(tick))
            ticks.push_back(tick);
    return ticks;
}

using Ticks = std::vector<std::uint64_t>;

TEST(Rhythm, ShowsTheTickOfTheSpawnAndEachKthBehindIt) {
    EXPECT_EQ(shown(rhythm(3, 8, 8), 8, 18), (Ticks{8, 11, 14, 17}));
    EXPECT_EQ(shown(rhythm(1, 8, 8), 8, 11), (Ticks{8, 9, 10, 11}));
}

TEST(Rhythm, WhoTakesOverIsShownThatTickAndThenThoseOfItsPredecessor) {
    EXPECT_EQ(shown(rhythm(3, 8, 12), 12, 18), (Ticks{12, 14, 17}));
}

TEST(Rhythm, TheNextOneIsThatWhichIsShownNext) {
    for (const std::uint64_t sat_down : {8, 12, 14}) {
        const Rhythm one = rhythm(3, 8, sat_down);
        const Ticks ticks = shown(one, sat_down, 30);
        for (std::size_t i = 0; i + 1 < ticks.size(); ++i)
            EXPECT_EQ(one.next(ticks[i]), ticks[i + 1]) << "sat down in " << sat_down;
    }
}

TEST(Rhythm, WithoutAWordItIsEachTickAndNoSpawnIsSlowerThanAScenarioMaySay) {
    EXPECT_EQ(Rhythm::of(world::CommandT(), 1, 1, step).every, 1U);
    EXPECT_EQ(rhythm(100, 1, 1).every, 100U);
    world::CommandT spawn;
    spawn.duration = 1e300;
    EXPECT_EQ(Rhythm::of(spawn, 1, 1, step).every, 100U);
}

}  // namespace
}  // namespace reprise::remote
