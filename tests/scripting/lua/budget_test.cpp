#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/lua/vm.h"
#include "tests/scripting/stage.h"
#include "world/check.h"

namespace reprise::scripting {

using test::mistake;
using testing::ElementsAre;
using testing::StartsWith;

namespace {

constexpr const char* spent =
    ": more than 10,000,000 instructions in one tick: a loop without wait()?";

}  // namespace

TEST(Budget, EndsALoopWithoutWaitAtItsLine) {
    EXPECT_EQ(mistake("\n\nwhile true do end"), std::string("test.lua:3") + spent);
}

TEST(Budget, CannotBeSwallowedByProtectedCalls) {
    EXPECT_EQ(mistake("while true do\npcall(function() while true do end end) end"),
              std::string("test.lua:2") + spent);
    EXPECT_EQ(mistake("while true do\nxpcall(function() while true do end end, print) end"),
              std::string("test.lua:2") + spent);
    EXPECT_EQ(
        mistake(
            "\nlocal t <close> = setmetatable({}, { __close = function() while true do end end })"
            " while true do end"),
        std::string("test.lua:2") + spent);
}

TEST(Budget, CannotBeEvadedByManyShortTasks) {
    const std::string message = mistake(
        "local function burst()\nfor i = 1, 100 do local x = i end start(burst) end burst() "
        "wait(1)");
    EXPECT_EQ(message, std::string("test.lua:2") + spent);
}

/// In the last tick checks look twice, before and behind physics.
TEST(Budget, IsOneForTheLastTickToo) {
    test::Stage stage(test::running(
        "check.never('slow', function()\nfor i = 1, 6000000 do end return false end) wait(100)"));
    stage.play(3);
    try {
        stage.conclude();
        FAIL() << "the last tick took two budgets";
    } catch (const world::Error& error) {
        EXPECT_EQ(error.what(), std::string("test.lua:2") + spent);
    }
}

TEST(Budget, HoldsInTheHeaderToo) {
    EXPECT_EQ(test::mistake_in_file("while true do end"),
              "test.lua:1: more than 2,500,000 instructions before the first tick: a loop outside "
              "of run?");
}

TEST(Budget, OfTheFirstTickIsWhole) {
    EXPECT_EQ(mistake("for i = 1, 9e6 do end"), "");
}

TEST(Budget, IsSpentByPowersThatAreNearlyNothing) {
    // A tenth of the budget in instructions, 1.6 times the budget with what they really take.
    const std::string loop = "local a, b, x = 1.0000001, -7.3e9 for i = 1, 5e5 do x = ";
    EXPECT_EQ(mistake(loop + "b ^ 3 x = a ^ 3 end"), "");
    EXPECT_EQ(mistake(loop + "a ^ b x = a ^ b end"), std::string("test.lua:1") + spent);
}

TEST(Budget, HoldsInChecksAndConditions) {
    EXPECT_EQ(mistake("check.never('x', function()\nwhile true do end end) wait(1)"),
              std::string("test.lua:2") + spent);
    EXPECT_EQ(mistake("wait_until(function()\nwhile true do end end)"),
              std::string("test.lua:2") + spent);
}

TEST(Budget, CountsLongStrings) {
    EXPECT_EQ(mistake("local s = string.rep('x', 60000) while true do local t = s .. 'x' end"),
              std::string("test.lua:1") + spent);
}

TEST(Budget, IsFullAgainInTheNextTick) {
    EXPECT_THAT(
        test::printed("for tick = 1, 5 do for i = 1, 2e6 do end wait_ticks(1) end print 'done'"),
        ElementsAre("done"));
}

TEST(Budget, TooMuchMemoryEndsTheRun) {
    EXPECT_THAT(
        mistake(
            "local t = {} pcall(function() for i = 1, 1e9 do t[i] = {} end end) t = nil wait(10)"),
        StartsWith("test.lua:1: the scenario needs more than 64 MB of memory"));
    EXPECT_THAT(mistake("local t = {} for i = 1, 2000 do t[i] = string.rep('x', 65000) .. i "
                        "if i % 100 == 0 then wait_ticks(1) end end"),
                StartsWith("test.lua:1: the scenario needs more than 64 MB of memory"));
}

TEST(Budget, EndlessRecursionEndsTheRunAndNothingCatchesIt) {
    for (const char* body : {"local function f() return 1 + f() end\nf()",
                             "local function f() return 1 + f() end\n"
                             "xpcall(f, function() while true do end end)"})
        EXPECT_THAT(mistake(body),
                    StartsWith("test.lua:1: calls are nested too deeply: an endless recursion?"))
            << body;
}

TEST(Budget, ALoopInAnErrorHandlerIsCountedToo) {
    EXPECT_EQ(mistake("xpcall(function() error 'a' end, function() while true do end end)"),
              std::string("test.lua:1") + spent);
}

TEST(Budget, AnErrorHandlerGetsTheErrorAndGivesTheAnswer) {
    EXPECT_THAT(test::printed("print(xpcall(function() error('a', 0) end, "
                              "function(e) return 'caught ' .. e end))"),
                ElementsAre("false caught a"));
}

TEST(Budget, InstructionCountIsEqualInEqualRuns) {
    const std::string body =
        "for i = 1, 30 do local t = {} for j = 1, 500 do t['k' .. j] = j end "
        "for k in pairs(t) do t[k] = nil end wait_ticks(1) end";
    test::Stage one(test::running(body));
    test::Stage two(test::running(body));
    one.play(40);
    two.play(40);
    EXPECT_EQ(one.digests, two.digests);
}

}  // namespace reprise::scripting
