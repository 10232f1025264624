#include "scripting/words/tasks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

using testing::ElementsAre;

TEST(Tasks, RoundsSecondsUpToTicksWithoutFallingForRoundingErrors) {
    constexpr std::uint64_t step = 50'000'000;
    EXPECT_EQ(ticks_of(0, step), 0U);
    EXPECT_EQ(ticks_of(0.001, step), 1U);
    EXPECT_EQ(ticks_of(0.05, step), 1U);
    EXPECT_EQ(ticks_of(0.051, step), 2U);
    for (std::uint64_t ticks = 1; ticks < 100'000; ++ticks)
        ASSERT_EQ(ticks_of(static_cast<double>(ticks) * 0.05, step), ticks);
}

TEST(Tasks, WaitGoesOnAfterTheTimeThatWasAsked) {
    EXPECT_THAT(
        test::printed("print(tick()) wait(0.12) print(tick()) wait_ticks(2) print(tick(), time())"),
        ElementsAre("0", "3", "5 0.25"));
}

TEST(Tasks, WaitingForNoTimeGoesOnAtOnce) {
    EXPECT_THAT(test::printed("wait(0) wait_ticks(0) print(tick())"), ElementsAre("0"));
}

TEST(Tasks, WaitUntilTestsAtOnceAndThenInEveryTick) {
    EXPECT_THAT(test::printed("print(wait_until(function() return true end), tick()) "
                              "print(wait_until(function() return tick() == 4 end), tick())"),
                ElementsAre("true 0", "true 4"));
}

TEST(Tasks, WaitUntilGivesUpAfterItsTimeout) {
    EXPECT_THAT(
        test::printed("local n = 0 "
                      "print(wait_until(function() n = n + 1 end, { timeout = 0.2 }), tick(), n)"),
        ElementsAre("false 4 5"));
}

TEST(Tasks, RunInTheOrderOfTheirStartAndStartInTheSameTick) {
    EXPECT_THAT(test::printed(R"(
        start(function() for i = 1, 2 do print('second', tick()) wait_ticks(1) end end)
        start(function() print('third', tick()) start(function() print('fourth', tick()) end) end)
        print('first', tick())
        wait_ticks(1)
        print('first', tick())
        wait_ticks(3))"),
                ElementsAre("first 0", "second 0", "third 0", "fourth 0", "first 1", "second 1"));
}

TEST(Tasks, ReturningFromRunEndsTheScenarioWithAllItsTasks) {
    test::Stage stage(
        test::running("start(function() while true do wait(1) end end) wait_ticks(2)"));
    stage.play(10);
    EXPECT_EQ(stage.reason(), "scenario ended");
    EXPECT_EQ(stage.digests.size(), 3U);
}

TEST(Tasks, FinishEndsTheRunAtOnce) {
    test::Stage stage(
        test::running("\n\nstart(function() print 'never' end) finish 'arrived' print 'never'"));
    EXPECT_THAT(stage.play(10), ElementsAre());
    EXPECT_EQ(stage.reason(), "arrived");
    EXPECT_EQ(stage.commands.back().line, 3U);
    EXPECT_TRUE(stage.step().tick.commands.empty());
}

TEST(Tasks, WaitPassesThroughProtectedCalls) {
    EXPECT_THAT(test::printed("print(pcall(function(a) wait(0.1) return a, tick() end, 'x')) "
                              "print(xpcall(function() wait(0.1) error('y', 0) end, "
                              "function(m) return m .. '!' end))"),
                ElementsAre("true x 2", "false y!"));
}

}  // namespace reprise::scripting
