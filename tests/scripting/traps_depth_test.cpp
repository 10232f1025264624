#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

// Traps of Lua, by their numbers in docs/lua-traps.md: depth of calls, length of texts and chains,
// size of tables.
namespace reprise::scripting {

using test::mistake;
using test::printed;
using test::running;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Trap36, DepthEndsInOneLine) {
    // Calls of Lua functions: a verdict. Through C: an error, 200 calls deep, the same everywhere.
    EXPECT_THAT(mistake("local function f() return 1 + f() end pcall(f) print 'caught'"),
                HasSubstr("calls are nested too deeply"));
    EXPECT_THAT(mistake("local function f(...) return f(1, ...) end pcall(f) print 'caught'"),
                HasSubstr("calls are nested too deeply"));
    for (const char* body :
         {"local function f() pcall(f) error('back', 0) end f()",
          "local function f() table.sort({ 2, 1 }, f) end f()",
          "local function f() string.gsub('a', 'a', f) end f()",
          "local t t = setmetatable({}, { __index = function(_, k) return t[k .. 'x'] end }) "
          "print(t.x)",
          "local t t = setmetatable({}, { __tostring = function() return tostring(t) end }) "
          "print(t)",
          "local t t = setmetatable({}, { __concat = function() return t .. t end }) print(t .. t)",
          "local m = {} m.__eq = function(a, b) return setmetatable({}, m) == b end "
          "print(setmetatable({}, m) == setmetatable({}, m))",
          "local function f() local c <close> = setmetatable({}, { __close = f }) end f()",
          "local function f() xpcall(error, f) error('back', 0) end f()",
          "local function f() for _ in f do end end f()",
          "string.find(('a'):rep(1000), ('a?'):rep(1000) .. 'b')",
          "string.find('x', ('('):rep(40))"}) {
        const std::string message = mistake(body);
        EXPECT_THAT(message, StartsWith("test.lua:1: ")) << body;
        EXPECT_EQ(message.find('\n'), std::string::npos) << body;
        EXPECT_EQ(mistake(body), message) << body;
    }
    std::string nested(5000, '(');
    EXPECT_EQ(test::mistake_in_file("\nreturn " + nested),
              "test.lua:2: blocks and brackets are nested more than 190 deep");
}

TEST(Trap36, ChainsOfMetatablesAreShort) {
    EXPECT_THAT(
        mistake("local t = {} for i = 1, 1000 do t = setmetatable({}, { __index = t }) end"),
        HasSubstr("a chain of more than 16 tables by __index"));
    // Built from the other end, too.
    EXPECT_THAT(mistake("local first = {} local t = first for i = 1, 1000 do local n = {} "
                        "setmetatable(t, { __newindex = n }) t = n end"),
                HasSubstr("a chain of more than 16 tables by __newindex"));
    EXPECT_THAT(mistake("local t = {} setmetatable(t, { __call = t })"),
                HasSubstr("__call must be a function"));
    EXPECT_THAT(
        printed(
            "local a = { x = 1 } a.__index = a local b = setmetatable({ y = 2 }, a) b.__index = b "
            "for i = 1, 100 do local c = setmetatable({}, b) assert(c.x == 1 and c.y == 2) end "
            "print 'ok'"),
        ElementsAre("ok"));
}

TEST(Trap36, ALongTextOrALargeTableEndsTheRun) {
    EXPECT_EQ(mistake("local s = ('x'):rep(60000)\nlocal t = s .. s"),
              "test.lua:2: a text of more than 64 kB: print or keep it in parts");
    EXPECT_THAT(
        mistake("pcall(function() local s = ('x'):rep(60000) local t = s .. s end) print 'caught'"),
        HasSubstr("a text of more than 64 kB"));
    EXPECT_THAT(mistake("local t = {} for i = 1, 200000 do t['k' .. i] = i if i % 2000 == 0 then "
                        "wait_ticks(1) end end"),
                HasSubstr("a table of more than 65,536 keys"));
    test::Stage stage(running("local t = {} for i = 1, 400000 do t[i] = i end print(#t)"));
    EXPECT_THAT(stage.play(2), ElementsAre("400000"));
}

}  // namespace reprise::scripting
