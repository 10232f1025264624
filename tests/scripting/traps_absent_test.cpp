#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/check.h"

// Traps of Lua, by their numbers in docs/lua-traps.md: what is not there, and what stands in its
// place.
namespace reprise::scripting {

using test::mistake;
using test::mistake_in_file;
using test::printed;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

void expect_absent(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        const auto dot = word.find('.');
        const std::string message =
            dot == std::string::npos
                ? "no variable or function '" + word + "'"
                : word.substr(0, dot) + " has no '" + word.substr(dot + 1) + "'";
        EXPECT_THAT(mistake("local x = " + word), HasSubstr("test.lua:1: " + message)) << word;
        // In the header as well as in the run.
        EXPECT_THAT(mistake_in_file("local x = " + word), HasSubstr("test.lua:1: " + message))
            << word;
    }
}

}  // namespace

TEST(Trap09, ChanceFollowsTheSeedOfTheRunOnly) {
    expect_absent({"math.random", "math.randomseed"});
    EXPECT_EQ(printed("print(random(), random_int(1, 1000))"),
              printed("print(random(), random_int(1, 1000))"));
    EXPECT_NE(printed("print(random())"), printed("random() print(random())"));
}

TEST(Trap10, ADrawInOneStreamMovesNoOther) {
    const auto alone = printed("print(random('gap'), random('gap'))");
    EXPECT_EQ(
        printed("random() local a = random('gap') random('x') random() print(a, random('gap'))"),
        alone);
}

TEST(Trap13, ThereIsNoOperatingSystem) {
    expect_absent({"os"});
    EXPECT_THAT(printed("print(tick(), time()) wait(1) print(tick(), time())"),
                ElementsAre("0 0.0", "20 1.0"));
}

TEST(Trap14, AScenarioReadsNoOtherFile) {
    expect_absent({"io", "dofile", "loadfile", "require", "package"});
}

TEST(Trap15, PrintedLinesAreEventsOfTheTickInTheirOrder) {
    test::Stage stage(
        test::running("print 'a'\nprint 'b' start(function() print 'd' end) print 'c' wait(1)"));
    testing::internal::CaptureStdout();
    const auto& draft = stage.step();
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    ASSERT_EQ(draft.tick.events.size(), 4U);
    EXPECT_EQ(draft.tick.events[1].text, "b");
    EXPECT_EQ(draft.tick.events[1].line, 2U);
    EXPECT_EQ(draft.tick.events[3].text, "d");
    expect_absent({"warn"});
}

TEST(Trap16, MemoryCannotBeAskedAboutOrCollected) {
    expect_absent({"collectgarbage"});
}

TEST(Trap17, ThereAreNoFinalizers) {
    EXPECT_THAT(mistake("setmetatable({}, { __gc = print })"),
                HasSubstr("setmetatable: __gc acts"));
    // Nor by the back door: a metatable counts as it was when it was set.
    EXPECT_THAT(
        printed("local m = {} local t = setmetatable({}, m) m.__gc = function() print 'gone' end "
                "t = nil for i = 1, 50 do local x = ('x'):rep(60000) .. i wait_ticks(1) end print "
                "'end'"),
        ElementsAre());
    EXPECT_THAT(mistake("local m = {} setmetatable({}, m) m.__gc = print setmetatable({}, m)"),
                HasSubstr("setmetatable: __gc acts"));
}

TEST(Trap18, ThereAreNoWeakTables) {
    for (const char* mode : {"'k'", "'v'", "'kv'", "3"})
        EXPECT_THAT(mistake(std::string("setmetatable({}, { __mode = ") + mode + " })"),
                    HasSubstr("setmetatable: __mode acts"));
    EXPECT_THAT(printed("local m = {} local t = setmetatable({}, m) m.__mode = 'k' t[{}] = 1 "
                        "for i = 1, 30 do local x = ('x'):rep(60000) .. i end "
                        "print(pcall(pairs, t))"),
                ElementsAre("false test.lua:1: pairs: a table as key has no order"));
}

TEST(Trap28, TextIsNeverRunAsCode) {
    expect_absent({"load", "loadstring", "string.dump"});
    EXPECT_THAT(mistake("local x = ('a').dump"), HasSubstr("string has no 'dump'"));
    EXPECT_THAT(mistake_in_file("\x1bLua"), HasSubstr("attempt to load a binary chunk"));
}

TEST(Trap31, ThereIsNoDebugLibrary) {
    expect_absent({"debug"});
    EXPECT_THAT(printed("print(getmetatable(''), pcall(setmetatable, '', {}))"),
                ElementsAre(HasSubstr("needs a table and a metatable")));
}

TEST(Trap40, AMistakeInACallbackEndsTheRunAtItsLine) {
    for (const char* body :
         {"start(function()\nerror 'mine' end) wait(1)",
          "check.never('x', function()\nerror 'mine' end) wait(1)",
          "wait_until(function()\nerror 'mine' end)",
          "table.sort({ 1, 2 }, function()\nerror 'mine' end)",
          "string.gsub('a', 'a', function()\nerror 'mine' end)",
          "print(setmetatable({}, { __tostring = function()\nerror 'mine' end }))"})
        EXPECT_EQ(mistake(body), "test.lua:2: mine") << body;
}

TEST(Trap42, AMisspelledNameIsAMistakeNotAVariable) {
    EXPECT_THAT(mistake("\nspede = 3"), HasSubstr("test.lua:2: 'spede' would be a global"));
    EXPECT_THAT(mistake("local x = spede"), HasSubstr("no variable or function 'spede'"));
    EXPECT_THAT(mistake("print = 3"), HasSubstr("'print' would be a global"));
    EXPECT_THAT(mistake("_ENV.x = 1"), HasSubstr("'x' would be a global"));
    EXPECT_THAT(mistake("for k in pairs(_ENV) do print(k) end print(_ENV.nothing)"),
                HasSubstr("no variable or function 'nothing'"));
    expect_absent({"_G", "rawset"});
}

TEST(Trap45, ARunKeepsTheSourceItBeganWith) {
    // The episode holds the scenario's text, and the scenario is made from the episode alone.
    const std::string first = test::running("wait_ticks(1) print 'first'");
    test::Stage stage(first);
    stage.step();
    stage.episode.scenario = test::running("print 'second'");
    EXPECT_THAT(stage.play(3), ElementsAre("first"));
}

}  // namespace reprise::scripting
