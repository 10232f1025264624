#include "scripting/lint.h"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lua.hpp>

#include "scripting/annotations.h"
#include "scripting/words/vocabulary.h"
#include "tests/scripting/stage.h"
#include "tests/support/worlds.h"

namespace reprise::scripting {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// "3: what is wrong", a finding a line.
std::string found_in(const std::string& source) {
    const world::TownT town = test::straight_road(400, 2);
    std::string text;
    for (const Finding& finding : lint(source, &town))
        text += std::to_string(finding.line) + ": " + finding.message + "\n";
    return text;
}

/// Of a run function's body, which begins in line 1.
std::string found(const std::string& body) {
    return found_in("return scenario 'test' { run = function(p) " + body + "\nend }");
}

}  // namespace

TEST(Lint, FindsWhatIsNotThereAlsoWhereNoRunComesAlong) {
    const std::pair<const char*, const char*> cases[] = {
        {"if false then\nwiat(3) end",
         "2: no variable or function 'wiat' (did you mean 'wait'?)\n"},
        {"local ego = spawn{ model = 'sedan' }\nif false then ego:brak(3) end",
         "2: an actor has no 'brak'"},
        {"if false then\ncheck.nver('x', print) end",
         "2: check has no 'nver' (did you mean 'never'?)\n"},
        {"local x = math.flor(3)", "1: math has no 'flor' (did you mean 'floor'?)\n"},
        {"spawn{ model = 'sedan',\nlaen = 'east_1' }",
         "2: unknown key 'laen' (did you mean 'lane'?)"},
        {"spawn{ model = 'sedna' }", "1: no model 'sedna' (did you mean 'sedan'?)"},
        {"spawn{ model = 'sedan', driver = 'trafic' }",
         "no driver 'trafic' (did you mean 'traffic'?)"},
        {"spawn{ model = 'sedan', lane = 'east_9' }",
         "no lane 'east_9' in straight_road (did you mean"},
        {"spawn{ model = 'sedan', lane = 'east' }",
         "'east' is an edge of straight_road: its lanes are"},
        {"spawn{ model = 'sedan', rig = { { name = 'a', fov = 3 } } }", "unknown key 'fov'"},
        {"set_weather 'hail'", "no weather 'hail'; reprise list"},
        {"set_weather('hail')", "no weather 'hail'; reprise list"},
        {"lane_length('east_9')", "no lane 'east_9'"},
        {"wait_until(function() return true end, { timout = 3 })",
         "unknown key 'timout' (did you mean 'timeout'?)"},
        {"local e = spawn{ model = 'sedan' }\ne:set_route{ 'east', 'wset_1' }",
         "2: no lane or edge 'wset_1'"},
        {"local e = spawn{ model = 'sedan' } e:change_lane('lft')", "no lane 'lft'"},
        {"total = 3", "1: 'total' would be a global: write 'local total' where it first appears\n"},
        {"print(p.gap)", "1: no parameter 'gap'; the header's params has none\n"},
    };
    for (const auto& [body, message] : cases)
        EXPECT_THAT(found(body), HasSubstr(message)) << body;
}

TEST(Lint, LetsPassWhatItCannotDecide) {
    for (const char* body : {
             "local lane = pick_lane{ length = 3 } spawn{ model = 'sedan', lane = lane }",
             "local t = { lane = 'nowhere', laen = 3 } t.run = function() end t:run() t.other = t",
             "local t = {} function t.help(a, b) return a == b end t:help()",
             "local s = ('a'):rep(3) print(s:upper(), #s, s .. 'b')",
             "for i = 1, 3 do local x <const> = i print(x) end goto done ::done::",
             "for k, v in pairs{ a = 1, b = 2 } do print(k, v) end",
             "local function f(...) return select('#', ...) end f(wait, 'hail')",
             "local name = 'sedan' spawn{ model = name, driver = name and 'traffic' or 'parked' }",
             "if time() == 3 then wait(1) elseif tick() >= 2 then wait(2) else wait(3) end",
             "repeat local done = true until done while false do wait(1) end",
             "local e = spawn{ model = 'child', lane = 'east_0' } e:walk{ to = { 1, 2 } } e:walk{ "
             "to = { x = 1, y = 2 } }",
             "check.never('blocked') check.max('a', function() local a, b = 1, 2 return a + b end, "
             "3, { stop = true })",
         })
        EXPECT_EQ(found(body), "") << body;
}

TEST(Lint, FindsParametersThatAreNotUsedOrNotThere) {
    EXPECT_EQ(
        found_in("return scenario 'a' {\n params = { gap = 3,\n speed = 4 },\n"
                 " run = function(p) print(p.gap, p.sped) end }"),
        "3: the parameter 'speed' is never used\n"
        "4: no parameter 'sped' (did you mean 'speed'?); the header's params has gap, speed\n");
    EXPECT_EQ(
        found_in(
            "return scenario 'a' { run = function(p) print(p.gap) end, params = { gap = 3 } }"),
        "");
    EXPECT_THAT(
        found_in("return scenario 'a' { twwn = 'x', run = function() end }"),
        HasSubstr("1: unknown key 'twwn' (did you mean 'town'?); there are cars, duration, "));
    EXPECT_THAT(found_in("return scenario('a'){ weather = 'hail', run = function() end }"),
                HasSubstr("no weather 'hail'"));
}

TEST(Annotations, DeclareEveryWordWithItsTypes) {
    const std::string text = annotations();
    for (const WordList& list : vocabulary())
        for (const Word& word : list.words) {
            const char* owner = list.owner == Owner::actor   ? "Actor:"
                                : list.owner == Owner::check ? "check."
                                : list.owner == Owner::task  ? "Task:"
                                                             : "";
            EXPECT_THAT(text, HasSubstr(std::string("\nfunction ") + owner + word.name + "("));
        }
    for (const KeyList& list : vocabulary_keys())
        EXPECT_THAT(text, HasSubstr(std::string("---@class ") + list.type + "\n"));
    EXPECT_THAT(text, HasSubstr("---@alias ModelName 'sedan'|"));
    EXPECT_THAT(
        text,
        HasSubstr("---@param options SpawnOptions\n---@return Actor\nfunction spawn(options) end"));
    // The file is Lua, and writes nothing that is not a word.
    const std::unique_ptr<lua_State, decltype(&lua_close)> machine(luaL_newstate(), &lua_close);
    EXPECT_EQ(luaL_loadbuffer(machine.get(), text.data(), text.size(), "=words"), LUA_OK)
        << lua_tostring(machine.get(), -1);
    EXPECT_THAT(lint(text, nullptr), IsEmpty());
}

}  // namespace reprise::scripting
