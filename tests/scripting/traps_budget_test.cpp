#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/check.h"

// Traps of Lua, by their numbers in docs/lua-traps.md: time and memory. Traps 16, 17, 19 and 20,
// which need several processes, are in across_processes_test.cpp as well.
namespace reprise::scripting {

using test::mistake;
using test::printed;
using test::running;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

constexpr const char* spent = "more than 10,000,000 instructions in one tick";
constexpr const char* full_budget = "the scenario needs more than 64 MB of memory";

/// How often this work fits into a tick that has nothing else to do: 2 to the power of it.
int rounds_in_a_tick(const std::string& before, const std::string& work) {
    int power = 0;
    while (power < 24 && mistake(before + " wait_ticks(1) for i = 1, " +
                                 std::to_string(1 << power) + " do " + work + " end")
                             .empty())
        ++power;
    return power;
}

}  // namespace

// Long texts pushed from C++ go by their size, not through Lua's cache of C strings, which would
// hit or miss by address.
TEST(Trap19, EqualRunsInOneProcessAskForEqualMemory) {
    const std::string body = running(
        "for i = 1, 20 do local ok, message = pcall(lane_length, ('long_'):rep(40) .. i) "
        "print(message) print(pick_lane{}, tostring(i / 7)) wait_ticks(1) end");
    test::Stage one(body);
    test::Stage two(body);  // elsewhere in memory, at the same time
    one.play(30);
    two.play(30);
    EXPECT_EQ(one.digests, two.digests);
    EXPECT_GT(one.digests.size(), 20U);
}

TEST(Trap20, NoProtectedCallCatchesTheEndOfMemory) {
    for (const char* fill : {"for i = 1, 1e9 do t[i] = i end",
                             "for i = 1, 1e9 do t = { t } end",
                             "for i = 1, 1e9 do t[i] = ('x'):rep(60000) .. i end",
                             "for i = 1, 1e9 do t[i] = function() return i end end"})
        for (const char* call :
             {"pcall(function() @ end)",
              "xpcall(function() @ end, function() end)",
              "table.sort({ 2, 1 }, function() @ end)",
              "('a'):gsub('a', function() @ end)",
              "local c <close> = setmetatable({}, { __close = function() @ end })"}) {
            std::string body = call;
            body.replace(body.find('@'), 1, fill);
            EXPECT_THAT(mistake("local t = {} while true do do " + body + " end t = {} end"),
                        AnyOf(HasSubstr(full_budget), HasSubstr(spent)))
                << body;
        }
    EXPECT_EQ(
        mistake("local t = {}\npcall(function()\nfor i = 1, 1e9 do t[i] = i end end) t = nil"),
        std::string("test.lua:3: ") + full_budget);
}

TEST(Trap20, WhatNobodyHoldsDoesNotCount) {
    EXPECT_THAT(
        printed("for i = 1, 40 do local t = {} for j = 1, 50 do t[j] = ('x'):rep(60000) .. j end "
                "wait_ticks(1) end print 'done'"),
        ElementsAre());
    test::Stage stage(
        running("for i = 1, 60 do local t = {} for j = 1, 50 do t[j] = ('x'):rep(60000) .. j end "
                "wait_ticks(1) end print 'done'"));
    EXPECT_THAT(stage.play(70), ElementsAre("done"));
}

TEST(Trap32, ALoopWithoutEndEndsTheRunAtItsLine) {
    for (const char* loop : {"\nwhile true do end",
                             "\nrepeat until false",
                             "\n::again:: goto again",
                             "\nfor i = 1, math.huge do end",
                             "\nfor i = 1, 2 do i = 1 while i do end end"})
        EXPECT_THAT(mistake(loop), StartsWith(std::string("test.lua:2: ") + spent)) << loop;
}

TEST(Trap33, ManyShortTasksShareOneAccount) {
    EXPECT_THAT(mistake("while true do for i = 1, 900 do end start(tick) wait(0) end"),
                HasSubstr("more than 2000 tasks at a time"));
    EXPECT_THAT(
        mistake("local function again() for i = 1, 500 do end start(again) end again() wait(9)"),
        HasSubstr(spent));
    // Tasks that each stay below the hook's interval are seen over the ticks.
    EXPECT_THAT(mistake("for i = 1, 1999 do start(function() while true do for j = 1, 6000 do end "
                        "wait_ticks(1) end end) end wait(9)"),
                HasSubstr(spent));
}

TEST(Trap34, NothingCatchesTheEndOfTheBudget) {
    constexpr const char* loop = "while true do end";
    for (const char* call :
         {"pcall(function() @ end)",
          "pcall(pcall, pcall, function() @ end)",
          "xpcall(function() @ end, function() end)",
          "xpcall(error, function() @ end)",
          "xpcall(function() error {} end, function() return pcall(function() @ end) end)",
          "local c <close> = setmetatable({}, { __close = function() pcall(function() @ end) end "
          "})",
          "pcall(table.sort, { 3, 2, 1 }, function() @ end)",
          "pcall(string.gsub, 'a', 'a', function() @ end)",
          "pcall(function() return setmetatable({}, { __index = function() @ end }).x end)",
          "pcall(tostring, setmetatable({}, { __tostring = function() @ end }))",
          "pcall(function() for x in function() @ end do end end)",
          "start(function() pcall(function() @ end) end) wait_ticks(2)",
          "wait_until(function() pcall(function() @ end) end)",
          "check.never('x', function() pcall(function() @ end) end) wait_ticks(3)"}) {
        std::string body = call;
        body.replace(body.find('@'), 1, loop);
        EXPECT_THAT(mistake("do " + body + " end while true do print 'caught' wait_ticks(1) end"),
                    HasSubstr(spent))
            << call;
    }
}

/// Scripts whose work Lua's instructions do not show; each would take minutes to days if only these
/// counted.
const std::vector<std::string>& long_work() {
    static const std::vector<std::string> all{
        "local s = ('9'):rep(65000) local a, b = s .. 'x', s .. 'x' while true do local x = a == b "
        "end",
        "local a, b = ('\\0'):rep(65000), ('\\0'):rep(65000) while true do local x = a < b end",
        "for i = 1, 9e6 do end local s = ('9'):rep(65000) while true do for i = 1, s do break end "
        "end",
        "local s = ('9'):rep(60000) while true do local x = s .. 'x' end",
        "local s = ('a'):rep(60000) while true do s:upper() s:reverse() s:lower() end",
        "local s = ('a'):rep(60000) while true do s:byte(1, 9000) end",
        "local s = ('9'):rep(60000) while true do tonumber(s) pcall(math.floor, s) end",
        "local s = ('a'):rep(60000) while true do utf8.len(s) utf8.offset(s, 50000) end",
        "local s = ('a'):rep(200) s:find('.-.-.-.-.-.-b')",
        "local s = ('a'):rep(60000) while true do s:find(('a'):rep(30000) .. 'b', 1, true) end",
        "local s = ('a'):rep(30000) while true do s:gsub('a', 'b') end",
        "local s = ('('):rep(60000) while true do s:find('%b()') end",
        "local s = ('%%'):rep(30000) while true do string.format(s) end",
        "while true do string.format('%.99f %.99f', 1e308, 1e308) end",
        "while true do ('x'):rep(65000) end",
        "while true do (''):rep(1e18) end",
        "local t = {} for i = 1, 60000 do t[i] = i end while true do table.insert(t, 1, 0) "
        "table.remove(t, 1) end",
        "local t = {} for i = 1, 60000 do t[i] = 'a' end while true do table.concat(t, '', 1, "
        "60000) end",
        "local t = {} for i = 1, 200 do t[i] = i end while true do table.unpack(t) "
        "table.pack(table.unpack(t)) end",
        "while true do table.move({}, 1, 900000, 2) end",
        "local t = setmetatable({}, { __len = function() return 1 << 50 end, __index = {} }) "
        "while true do table.unpack(t, 1, 500) table.insert(t, 1, 1) end",
        "local t = {} for i = 1, 1e6 do t[i] = i end local i = 0 "
        "while true do i = i + 1 t['k' .. i] = 1 t['k' .. i] = nil end",
        "local t = {} for i = 1, 16384 do t['k' .. i] = i end local i = 0 "
        "while true do i = i + 1 t['x' .. i] = 1 t['x' .. i] = nil end",
        "local t = {} for i = 1, 30000 do t['k' .. i] = i end for i = 1, 30000 do t['k' .. i] = "
        "nil end "
        "while true do pairs(t) next(t) end",
        "local t = {} for i = 1, 20000 do t[i] = i * 7919 % 20011 end while true do table.sort(t) "
        "end",
        "local function f(...) local function g() end while true do g(...) end end "
        "local t = {} for i = 1, 9000 do t[i] = i end f(table.unpack(t))",
        "while true do pcall(error) end",
        "while true do pcall(function() return spwan end) end",
        "while true do pcall(lane_length, 'esat_1') end",
        "local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20 } while true do gap(ego, ego) "
        "ego:lane() end",
        "while true do pick_lane{} end"};
    return all;
}

TEST(Trap35, WorkInsideOneInstructionIsCharged) {
    for (const std::string& body : long_work())
        EXPECT_THAT(mistake("\n" + body), StartsWith(std::string("test.lua:2: ") + spent)) << body;
}

// Integers hash to their remainder: multiples of 2^n - 1 all meet in one place of 2^n.
TEST(Trap35, KeysWhoseHashesAgreeMakeInstructionsDearer) {
    const auto rounds = [](const std::string& key) {
        return rounds_in_a_tick("local t = {} for i = 1, 1000 do t[" + key +
                                    "] = 1 end local k = 1023 "
                                    "for i = 1, 300 do for j = 1, 1000 do end if i % 100 == 0 then "
                                    "wait_ticks(1) end end",
                                "for j = 1, 100 do local x = t[k] end");
    };
    EXPECT_GE(rounds("i * 1019"), 4 + rounds("i * 1023"));
}

TEST(Trap35, LongerWorkIsChargedMore) {
    const struct {
        const char* text;
        const char* work;
    } cases[] = {
        {"local a, b = ('x'):rep(@) .. 'y', ('x'):rep(@) .. 'y'",
         "for j = 1, 100 do local x = a == b end"},
        {"local a = ('x'):rep(@)", "a:upper()"},
        {"local a = ('x'):rep(@)", "a:find('x-y')"},
        {"local t = {} for i = 1, @ do t[i] = i end", "table.insert(t, 1, 1) table.remove(t, 1)"},
        {"local t = {} for i = 1, @ do t[i] = 'a' end", "table.concat(t)"},
        {"local t = {} for i = 1, @ do t['k' .. i] = i end", "pairs(t)"}};

    for (const auto& [text, work] : cases) {
        const auto with_size = [&](const std::string& size) {
            std::string before = text;
            for (auto at = before.find('@'); at != std::string::npos; at = before.find('@'))
                before.replace(at, 1, size);
            return rounds_in_a_tick(before, work);
        };
        EXPECT_GE(with_size("500"), 2 + with_size("16000")) << work;
    }
}

TEST(Trap35, HonestWorkFitsIntoATick) {
    EXPECT_THAT(printed(R"(
        local words, lines, keyed = {}, {}, {}
        for i = 1, 10000 do words[i] = 'word' .. i end
        for i = 1, 5000 do keyed['k' .. i] = i end
        for i = 1, 200 do lines[i] = string.format('%d %.3f %s', i, i / 7, words[i]) end
        local text = table.concat(lines, '\n')
        local count = 0
        for name, number in text:gmatch('(%a+)(%d+)') do count = count + #name * #number end
        table.sort(words, function(a, b) return a < b end)
        for key in pairs(keyed) do count = count + #key end
        print(count > 0, #text > 2000, text:find('word150 *\n'), (text:gsub('word', 'w')):sub(1, 9)))"),
                ElementsAre(StartsWith("true true ")));
}

}  // namespace reprise::scripting
