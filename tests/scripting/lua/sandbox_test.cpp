#include "scripting/lua/sandbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

using test::mistake;
using test::printed;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Sandbox, PairsWalksNumbersThenStringsThenBooleans) {
    EXPECT_THAT(printed(R"(
        local t = { z = 1, b = 1, [10] = 1, [2.5] = 1, [-3] = 1, a = 1, [true] = 1, [2] = 1, [false] = 1 }
        local keys = {}
        for key in pairs(t) do keys[#keys + 1] = tostring(key) end
        print(table.concat(keys, ' '))
        print(next({ b = 2, a = 1 }), next({ b = 2, a = 1 }, 'b'), next({})))"),
                ElementsAre("-3 2 2.5 10 a b z false true", "a nil nil"));
}

TEST(Sandbox, PairsOrderDoesNotDependOnHistory) {
    EXPECT_THAT(printed(R"(
        local function walk(t)
            local keys = {}
            for key, value in pairs(t) do keys[#keys + 1] = key .. value end
            return table.concat(keys)
        end
        local up, down = {}, {}
        for i = 1, 200 do up['k' .. i] = i; down['k' .. (201 - i)] = 201 - i end
        for i = 201, 400 do up['k' .. i] = i end
        for i = 201, 400 do up['k' .. i] = nil end
        print(walk(up) == walk(down)))"),
                ElementsAre("true"));
}

TEST(Sandbox, PairsWalksASnapshotThatSurvivesChanges) {
    EXPECT_THAT(printed(R"(
        local t, seen = { a = 1, b = 2, c = 3 }, ''
        for key in pairs(t) do seen = seen .. key; t.b = nil; t['new' .. key] = 1 end
        print(seen))"),
                ElementsAre("ac"));
}

TEST(Sandbox, KeysWithoutAnOrderAreRefused) {
    EXPECT_EQ(mistake("\nfor key in pairs{ [{}] = 1 } do end"),
              "test.lua:2: pairs: a table as key has no order");
    EXPECT_EQ(mistake("next({ [print] = 1 })"), "test.lua:1: next: a function as key has no order");
}

TEST(Sandbox, SortIsStable) {
    EXPECT_THAT(printed(R"(
        local list = {}
        for i = 1, 1000 do list[i] = { rank = i * 7919 % 10, place = i } end
        table.sort(list, function(a, b) return a.rank < b.rank end)
        local good = true
        for i = 2, #list do
            local a, b = list[i - 1], list[i]
            good = good and (a.rank < b.rank or (a.rank == b.rank and a.place < b.place))
        end
        print(good, #list)
        local numbers = { 3, 1, 2 }
        table.sort(numbers)
        print(table.concat(numbers, ' ')))"),
                ElementsAre("true 1000", "1 2 3"));
}

TEST(Sandbox, SortSurvivesAnOrderThatContradictsItself) {
    EXPECT_THAT(printed("local t = {} for i = 1, 500 do t[i] = i % 7 end "
                        "table.sort(t, function() return true end) print(#t)"),
                ElementsAre("500"));
}

TEST(Sandbox, TextsHoldNoAddresses) {
    EXPECT_THAT(printed(R"(
        print({}, print, tostring({}), string.format('%s %5.1f%%', {}, 2))
        print(setmetatable({}, { __tostring = function() return 'me' end }))
        print(select(2, pcall(error, {})), select(2, pcall(function() local x = {} .. 'a' end))))"),
                ElementsAre("table function table table   2.0%",
                            "me",
                            "table test.lua:4: attempt to concatenate a table value"));
}

TEST(Sandbox, NumbersPrintAsTheShortestTextThatReadsBack) {
    EXPECT_THAT(printed("print(0.1 + 0.2, 1/3, 1e15, 5, 5.0, 0/0, -1/0, 2^53)"),
                ElementsAre("0.30000000000000004 0.3333333333333333 1e+15 5 5.0 nan -inf "
                            "9007199254740992.0"));
}

TEST(Sandbox, WhatReachesOutIsNotThere) {
    for (const char* word : {"os",
                             "io",
                             "debug",
                             "package",
                             "coroutine",
                             "require",
                             "load",
                             "dofile",
                             "loadfile",
                             "loadstring",
                             "collectgarbage",
                             "rawset",
                             "_G",
                             "warn"})
        EXPECT_THAT(mistake(std::string("local x = ") + word),
                    HasSubstr(std::string("test.lua:1: no variable or function '") + word + "'"));
    EXPECT_THAT(mistake("local x = math.random()"),
                HasSubstr("test.lua:1: math has no 'random' (use random() or random_int()"));
    EXPECT_THAT(mistake("math.randomseed(1)"), HasSubstr("math has no 'randomseed'"));
    EXPECT_THAT(mistake("local x = string.dump"), HasSubstr("string has no 'dump'"));
    EXPECT_THAT(mistake("local x = ('a'):dump()"), HasSubstr("string has no 'dump'"));
    EXPECT_THAT(mistake("print(string.format('%p', {}))"), HasSubstr("%p would show an address"));
}

TEST(Sandbox, GlobalsAreSealed) {
    EXPECT_EQ(mistake("\nspeed = 3"),
              "test.lua:2: 'speed' would be a global: write 'local speed' where it first appears");
    EXPECT_EQ(mistake("spwan{}"),
              "test.lua:1: no variable or function 'spwan' (did you mean 'spawn'?)");
    EXPECT_EQ(mistake("math.flor(2)"), "test.lua:1: math has no 'flor' (did you mean 'floor'?)");
    EXPECT_EQ(mistake("setmetatable(_ENV, {})"),
              "test.lua:1: setmetatable: this metatable is protected");
    EXPECT_EQ(mistake("local x = _actor"), "test.lua:1: no variable or function '_actor'");
}

TEST(Sandbox, FinalizersAndWeakTablesAreRefused) {
    EXPECT_THAT(mistake("setmetatable({}, { __gc = print })"),
                HasSubstr("setmetatable: __gc acts when"));
    EXPECT_THAT(mistake("setmetatable({}, { __mode = 'k' })"),
                HasSubstr("setmetatable: __mode acts when"));
    // Nor can they slip in later: what was set is a copy.
    EXPECT_THAT(printed(R"(
        local meta = { __index = { a = 1 } }
        local t = setmetatable({}, meta)
        meta.__index = nil
        print(t.a, getmetatable(t) == meta, getmetatable('')))"),
                ElementsAre("1 true"));
}

TEST(Sandbox, TextsAreNoNumbers) {
    EXPECT_THAT(mistake("print('10' + 1)"),
                HasSubstr("attempt to perform arithmetic on a string value"));
}

TEST(Sandbox, LongWorkInOneCallIsRefused) {
    EXPECT_EQ(mistake("string.rep('x', 1e9)"),
              "test.lua:1: string.rep: the result would be longer than 64 kB");
    EXPECT_THAT(mistake("table.move({}, 1, 1e9, 2)"), HasSubstr("table.move: more than 1,000,000"));
    EXPECT_THAT(mistake("table.concat({}, '', 1, 1e9)"), HasSubstr("more than 1,000,000"));
}

}  // namespace reprise::scripting
