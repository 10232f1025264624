#include "scripting/run/tasks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

using test::mistake;
using test::printed;
using testing::ElementsAre;
using testing::HasSubstr;

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

TEST(Conditions, MayWaitThemselves) {
    EXPECT_THAT(printed("local n = 0 "
                        "print(wait_until(function() n = n + 1 wait_ticks(2) return n == 3 end), "
                        "tick())"),
                ElementsAre("true 8"))
        << "0..2, 3..5, 6..8: asked again in the tick behind its answer";
    EXPECT_THAT(printed(R"(
        local seen = {}
        wait_until(function()
            wait_until(function() seen[#seen + 1] = tick() return tick() % 2 == 1 end)
            return tick() > 2
        end)
        print(table.concat(seen, ' ')))"),
                ElementsAre("0 1 2 3"));
}

TEST(Conditions, MayAskForActorsThatAreStillToCome) {
    EXPECT_THAT(
        printed("local ego "
                "wait_until(function() ego = ego or spawn{ model = 'sedan', lane = 'east_1', "
                "s = 20, speed = 10 } return ego:x() > 21 end) print(tick(), ego:x())"),
        ElementsAre("3 21.5"));
}

TEST(Conditions, MistakesAreThoseOfTheTaskThatWaits) {
    EXPECT_EQ(mistake("\nwait_until(function()\nreturn tick() > 2 and nothing.x end)"),
              "test.lua:3: no variable or function 'nothing' (did you mean 'string'?)");
    EXPECT_EQ(
        mistake("local ego = spawn{ model = 'sedan' } wait(0.1)\n"
                "wait_until(ego.speed)"),
        "test.lua:2: actor: an actor is needed as argument 1, got no value: write ego:speed(), "
        "gap(ego, other)");
    EXPECT_THAT(printed("print(pcall(function() "
                        "wait_until(function() if tick() > 2 then error('late', 0) end end) end)) "
                        "print(pcall(wait_until, function() if tick() > 4 then error() end end)) "
                        "print(wait_until(function() return tick() == 7 end), tick())"),
                ElementsAre("false late", "false nil", "true 7"));
}

TEST(Conditions, AreTestedInTheTaskThatWaitsAndInItsTurn) {
    EXPECT_THAT(printed(R"(
        start(function() wait_until(function() print('second', tick()) return tick() == 2 end) end)
        wait_until(function() print('first', tick()) return tick() == 2 end)
        wait(1))"),
                ElementsAre("first 0", "second 0", "first 1", "second 1", "first 2", "second 2"));
}

TEST(Task, IsDoneWhenItsFunctionHasReturned) {
    EXPECT_THAT(printed(R"(
        local task = start(function() wait_ticks(2) end)
        for _ = 1, 4 do print(tick(), task:done()) wait_ticks(1) end)"),
                ElementsAre("0 false", "1 false", "2 false", "3 true"))
        << "in tick 2 its turn comes behind that of the first task";
}

TEST(Task, IsWaitedForAndWhoWaitsGoesOnInTheSameTick) {
    EXPECT_THAT(printed(R"(
        local task = start(function() wait_ticks(2) print('ends', tick()) end)
        start(function() while true do print('last', tick()) wait_ticks(1) end end)
        print(task:wait(), tick())
        print(wait_for(task), tick()))"),
                ElementsAre("last 0", "last 1", "ends 2", "true 2", "true 2"));
}

TEST(Task, IsWaitedForNoLongerThanTheTimeout) {
    EXPECT_THAT(printed(R"(
        local task = start(function() wait_ticks(5) end)
        print(wait_for(task, { timeout = 0.1 }), tick())
        print(task:wait{ timeout = 0 }, tick())
        for _ = 1, 3 do print(task:wait{ timeout = 0.1 }, tick()) end)"),
                ElementsAre("false 2", "false 2", "false 4", "true 5", "true 5"));
}

TEST(Task, RunsNoMoreCodeOnceItIsCancelled) {
    EXPECT_THAT(printed(R"(
        local task = start(function()
            local guard <close> = setmetatable({}, { __close = function() print 'closed' end })
            while true do print('runs', tick()) wait_ticks(1) end
        end)
        local sleeper = start(function() print 'never' end)
        sleeper:cancel()
        wait_ticks(2)
        task:cancel()
        task:cancel()
        print(task:done(), sleeper:done(), task:wait(), tick())
        wait_ticks(3))"),
                ElementsAre("runs 0", "runs 1", "true true true 2"));
}

TEST(Task, MayCancelItself) {
    EXPECT_THAT(printed(R"(
        local task
        task = start(function() wait_ticks(1) task:cancel() print 'never' end)
        local asks
        asks = start(function() wait_until(function() asks:cancel() return true end) print 'never' end)
        print(task:wait(), tick(), asks:done()))"),
                ElementsAre("true 1 true"));
    EXPECT_EQ(
        mistake(R"(
        local task
        task = start(function() table.sort({ 1, 2 }, function() task:cancel() end) end)
        wait(1))"),
        "test.lua:3: cancel: a task cannot end itself here, inside another function's call back");
}

TEST(Task, WakesWhoWaitsForItWhenItIsCancelled) {
    EXPECT_THAT(printed(R"(
        local task = start(function() wait(100) end)
        start(function() print('told', task:wait(), tick()) end)
        wait_ticks(2)
        task:cancel()
        print('goes on', tick())
        wait_ticks(1))"),
                ElementsAre("goes on 2", "told true 2"));
}

TEST(Parallel, ReturnsWhenTheLastOneHasEnded) {
    EXPECT_THAT(printed(R"(
        parallel{ function() wait_ticks(3) print('slow', tick()) end,
                  function() print('at once', tick()) end }
        print('behind', tick()))"),
                ElementsAre("at once 0", "slow 3", "behind 3"));
}

TEST(Parallel, BeginsInItsOrderBehindAllOtherTasks) {
    EXPECT_THAT(printed(R"(
        start(function() print 'started' end)
        parallel{ function() print 'one' end, function() print 'two' end }
        print('behind', tick()))"),
                ElementsAre("started", "one", "two", "behind 0"));
}

TEST(Race, ReturnsWhoWonAndWhatItSaid) {
    EXPECT_THAT(printed(R"(
        print(race{ function() wait_ticks(3) print 'never' end,
                    function() wait_ticks(2) return 'fast', 'and more' end })
        print(tick())
        print(race{ function() end })
        wait_ticks(5))"),
                ElementsAre("2 fast", "2", "1"));
}

TEST(Race, GoesToTheFirstOfThoseThatEndInOneTick) {
    EXPECT_THAT(printed(R"(
        print(race{ function() wait_ticks(2) return 'a' end,
                    function() wait_ticks(2) print 'never' end })
        print(race{ function() return 'a' end, function() print 'never' end }))"),
                ElementsAre("1 a", "1 a"));
}

TEST(Together, EndsWithTheTaskThatAskedForIt) {
    EXPECT_THAT(printed(R"(
        local task = start(function()
            parallel{ function() race{ function() while true do print(tick()) wait_ticks(1) end end } end }
        end)
        local free = start(function() start(function() wait_ticks(4) print('free', tick()) end) wait(9) end)
        wait_ticks(2)
        task:cancel()
        free:cancel()
        wait_ticks(5))"),
                ElementsAre("0", "1", "free 4"))
        << "who was started beside goes on";
}

TEST(Together, MayBeNested) {
    EXPECT_THAT(printed(R"(
        local function after(n, word) return function() wait_ticks(n) return word end end
        print(race{
            function() parallel{ after(1), after(4) } return 'both' end,
            function() local _, word = race{ after(7, 'seven'), after(3, 'three') } wait_ticks(2) return word end,
        })
        print(tick()))"),
                ElementsAre("1 both", "4"));
}

TEST(Together, AMistakeInOneEndsTheRunAtItsLine) {
    EXPECT_EQ(
        mistake("parallel{ function() wait(9) end,\nfunction() wait_ticks(2)\nerror 'off' end }"),
        "test.lua:3: off");
}

TEST(Together, TwoThousandTasksAreTheMost) {
    EXPECT_THAT(printed(R"(
        local list = {}
        for i = 1, 1999 do list[i] = function() wait_ticks(1) return i end end
        parallel(list)
        print(tick())
        print(race(list))
        list[2000] = list[1]
        print(select(2, pcall(parallel, list))))"),
                ElementsAre("1", "1 1", "test.lua:8: parallel: more than 2000 tasks at a time"));
}

TEST(Together, SaysWhatIsWrong) {
    EXPECT_EQ(mistake("parallel()"),
              "test.lua:1: parallel: needs a list of functions: parallel{ drive, walk }");
    EXPECT_EQ(mistake("race{}"),
              "test.lua:1: race: needs a list of functions: race{ drive, walk }");
    EXPECT_EQ(mistake("race{ function() end, 3 }"),
              "test.lua:1: race: entry 2 must be a function, got 3");
    EXPECT_EQ(
        mistake("wait_for(3)"),
        "test.lua:1: wait_for: a task is needed, got number: local task = start(function() ... "
        "end)");
    EXPECT_EQ(mistake("wait_for(start(function() end), { timeout = -1 })"),
              "test.lua:1: wait_for: 'timeout' must be in [0, 1e9] s");
    EXPECT_EQ(mistake("start(function() end):stop()"), "test.lua:1: a task has no 'stop'");
    EXPECT_EQ(mistake("local me\nme = start(function()\nme:wait() end) wait(1)"),
              "test.lua:3: wait_for: a task cannot wait for its own end");
    EXPECT_EQ(mistake("wait_until(function()\nreturn tick() > 1 and race{ wait } end)"),
              "test.lua:2: race: a condition cannot wait for tasks: ask task:done()");
    EXPECT_THAT(
        mistake("local t = start(function() end) check.never('x', function() t:cancel() end) "
                "wait(1)"),
        HasSubstr("a check may look, but not act or wait"));
    EXPECT_EQ(
        mistake("local t = start(function() wait(1) end) check.max('x', function() return t:done() "
                "and 1 or 0 end, 1) wait(1)"),
        "");
}

}  // namespace reprise::scripting
