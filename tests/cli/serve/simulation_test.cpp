// Episodes of one's own from C++; serve_test.py holds the server itself to its promises.
#include "remote/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "world/check.h"

namespace reprise::test {
namespace {

using remote::Simulation;
using testing::HasSubstr;

class SimulationClient : public testing::Test {
  protected:
    /// What is said where something cannot be.
    template <class Action>
    static std::string mistake(Action action) {
        try {
            action();
        } catch (const world::Error& error) {
            return error.what();
        }
        return "";
    }

    Simulation::Server own() const {
        return {.folder = folder_.path().string(), .program = REPRISE_PROGRAM};
    }

    const Folder folder_;
};

TEST_F(SimulationClient, ATaskIsDrivenToItsGoalAndDrivenAgain) {
    Simulation sim(own());
    const remote::EpisodePlan plan{.town = "town1",
                                   .seed = 7,
                                   .start = remote::OnLane{"b1_b2_1", 20},
                                   .goal = remote::OnLane{"b1_b2_1", 60},
                                   .trace = "task.mcap"};
    std::vector<world::Digest128> ends;
    for (int episode = 0; episode < 2; ++episode) {
        world::Digest128 chain;
        for (auto tick = sim.reset(plan); tick;) {
            chain = tick->tick->digests()->chain();
            const auto* own = world::find(tick->measurements(), sim.run().actor());
            ASSERT_NE(own, nullptr);
            tick = sim.step({.throttle = own->speed() < 8 ? 0.5 : 0.0});
        }
        EXPECT_EQ(sim.outcome().verdict, "passed");
        EXPECT_EQ(sim.outcome().reason, "arrived");
        ends.push_back(chain);
    }
    EXPECT_TRUE(ends[0] == ends[1]);
    EXPECT_EQ(reprise({"verify", "task.mcap"}, folder_.path()).code, 0);
    EXPECT_EQ(mistake([&] { sim.step({}); }), "no episode runs: reset() begins one");
}

TEST_F(SimulationClient, MistakesAreThrownWithTheirLineAndTheNextResetGoesOn) {
    Simulation sim(own());
    EXPECT_THAT(mistake([&] { sim.run(); }), HasSubstr("there was no episode yet"));
    const std::string broken =
        "return scenario 'broken' {\n    run = function()\n        spam()\n    end,\n}\n";
    EXPECT_THAT(mistake([&] { sim.reset({.source = broken}); }), HasSubstr("scenario.lua:3: "));
    EXPECT_THAT(mistake([&] { sim.reset({.file = "../x.lua"}); }), HasSubstr("server's folder"));
    EXPECT_THAT(mistake([&] { sim.reset({.town = "town1", .weather = "hail"}); }),
                HasSubstr("no weather 'hail'"));
    auto tick = sim.reset({.town = "town1", .seconds = 0.2});
    ASSERT_TRUE(tick);
    EXPECT_THAT(mistake([&] { sim.step({.steer = 2}); }), HasSubstr("said steer = 2"));
    tick = sim.reset({.town = "town1", .seconds = 0.2});
    while (tick)
        tick = sim.step({});
    EXPECT_EQ(sim.outcome().ticks, 4U);
}

TEST_F(SimulationClient, ATasksCamerasAreSeen) {
    Simulation sim(own());
    remote::EpisodePlan plan{.town = "town1", .seconds = 0.2};
    plan.rig.push_back({.sensor = {.name = "front", .width = 64, .height = 48}, .every = 2});
    auto tick = sim.reset(plan);
    ASSERT_TRUE(tick);
    const auto picture = sim.run().picture("front");
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->pixels.size(), 64U * 48 * 3);
    ASSERT_TRUE(sim.step({}));
    EXPECT_FALSE(sim.run().picture("front")) << "it looks at every second tick";
}

TEST_F(SimulationClient, ATaskIsShownAsManyTicksAsWasSaidAndToldOfTheOthers) {
    Simulation sim(own());
    remote::EpisodePlan plan{.town = "town1", .every = 4, .seconds = 1};
    plan.rig.push_back({.sensor = {.name = "front", .width = 16, .height = 16}});
    std::vector<std::uint64_t> shown, passed;
    for (auto tick = sim.reset(plan); tick; tick = sim.step({.throttle = 0.5})) {
        shown.push_back(tick->index());
        for (const world::Tick* one : sim.run().passed())
            passed.push_back(one->index());
        EXPECT_TRUE(sim.run().picture("front"));
    }
    EXPECT_EQ(shown, (std::vector<std::uint64_t>{1, 5, 9, 13, 17}));
    EXPECT_EQ(passed, (std::vector<std::uint64_t>{2, 3, 4, 6, 7, 8, 10, 11, 12, 14, 15, 16}));
    EXPECT_EQ(sim.outcome().ticks, 20U);
}

TEST_F(SimulationClient, WhereNoServerIsItSaysSo) {
    EXPECT_THAT(mistake([&] { const Simulation sim({.address = folder_ / "s"}); }),
                HasSubstr("s: nobody is there: No such file"));
    EXPECT_THAT(mistake([&] { const Simulation sim({.address = "127.0.0.1:1"}); }),
                HasSubstr("127.0.0.1:1: nobody is there: Connection refused"));
    EXPECT_THAT(mistake([&] { const Simulation sim({.program = "/no/such"}); }),
                HasSubstr("name it in the variable REPRISE"));
}

}  // namespace
}  // namespace reprise::test
