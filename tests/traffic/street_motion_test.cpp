// How SUMO's cars move as they are shown, told from the ticks alone. `street_motion TRACE ...`
// tells the same of any trace.
#include "tests/support/street_motion.h"

#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/traffic/stage.h"

namespace reprise::test {
namespace {

constexpr double step = 0.05;  // [s]

/// Two minutes: red lights, queues, turns, changes of lanes.
const StreetMotion& busy(const std::string& town, std::uint32_t cars) {
    static std::map<std::string, StreetMotion> seen;
    const auto found = seen.find(town);
    if (found != seen.end())
        return found->second;
    const Loaded& loaded = own_town(town);
    Stage stage(loaded, cars);
    StreetMotion motion(loaded.town, step);
    for (int i = 0; i < 2400; ++i) {
        stage.step();
        motion.see(stage.view());
    }
    return seen.emplace(town, std::move(motion)).first->second;
}

double share(const StreetMotion::Count& count, const StreetMotion& motion) {
    return static_cast<double>(count.times) / static_cast<double>(motion.car_ticks);
}

class StreetMotionOf : public testing::TestWithParam<std::pair<const char*, std::uint32_t>> {
  protected:
    const StreetMotion& motion = busy(GetParam().first, GetParam().second);
};

TEST_P(StreetMotionOf, StandingCarsStand) {
    EXPECT_GT(motion.car_ticks, 90'000U);
    EXPECT_EQ(motion.slides.times, 0U) << motion.text();
    EXPECT_EQ(motion.spins.times, 0U) << motion.text();
    EXPECT_LT(share(motion.sidesteps, motion), 2e-5) << motion.text();
}

TEST_P(StreetMotionOf, NobodyJumps) {
    EXPECT_EQ(motion.jumps.times, 0U) << motion.text();
    EXPECT_EQ(motion.backward.times, 0U) << motion.text();
    EXPECT_EQ(motion.heading_steps.times, 0U) << motion.text();
}

/// Over ten minutes it is less than 0.1 for a thousand car-ticks; two are fewer than it takes to
/// see that: one meeting of a second is 0.1 by itself.
TEST_P(StreetMotionOf, NobodyDrivesThroughOthers) {
    EXPECT_LT(share(motion.overlaps, motion), 4e-4) << motion.text();
}

TEST_P(StreetMotionOf, NobodyTurnsWithoutTheIndicator) {
    EXPECT_GT(motion.turns, 100U) << motion.text();
    EXPECT_EQ(motion.dark_turns.times, 0U) << motion.text();
}

TEST_P(StreetMotionOf, BendsAreTakenByTheirCurvature) {
    EXPECT_LT(share(motion.hard_bends, motion), 0.005) << motion.text();
}

TEST_P(StreetMotionOf, BrakeLampsAreTrue) {
    EXPECT_EQ(motion.dark_brakes.times, 0U) << motion.text();
    EXPECT_EQ(motion.false_brakes.times, 0U) << motion.text();
}

/// A bus's rear axle used to go where its bumper had been, sideways where the corner is tight.
TEST(StreetMotionIn, TightCornersLongVehiclesRollAndDoNotSlide) {
    const Loaded quarter = load(own_map("quarter.net.xml"));
    Stage stage(quarter, 40);
    StreetMotion motion(quarter.town, step);
    for (int i = 0; i < 1500; ++i) {
        stage.step();
        motion.see(stage.view());
    }
    EXPECT_EQ(motion.sidesteps.times, 0U) << motion.text();
    EXPECT_EQ(motion.jumps.times, 0U) << motion.text();
}

INSTANTIATE_TEST_SUITE_P(Towns,
                         StreetMotionOf,
                         testing::Values(std::pair{"town1", 100U}, std::pair{"town2", 70U}),
                         [](const auto& which) { return which.param.first; });

}  // namespace
}  // namespace reprise::test
