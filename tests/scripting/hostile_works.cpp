#include "tests/scripting/hostile.h"
#include "tests/scripting/stage.h"

namespace reprise::test {

namespace {

/// An endless loop over the work, which is written out many times: little else is in it.
LazyText again(const LazyText& work, int count = 100) {
    return "while true do " + times(count, work + " ") + "end";
}

LazyText running_lazily(const LazyText& body) {
    return std::function<std::string()>([body] { return running("\n" + body.made()); });
}

std::string variables(int count) {
    std::string names = "a0";
    for (int i = 1; i < count; ++i)
        names += ",a" + std::to_string(i);
    return names;
}

/// 3^13 texts of one hash, by Lua's own method and our seed: of each row one, joined.
const char* const texts_of_one_hash = R"(local B =
{{'\007\242\003','\038\243\003','\069\244\003'},{'\026\028\248','\026\056\247','\026\087\246'},
{'\255\025\184','\255\059\183','\255\092\182'},{'\255\020\064','\255\053\065','\255\087\062'},
{'\255\018\253','\255\052\250','\255\085\251'},{'\023\060\006','\023\091\007','\023\122\004'},
{'\017\159\255','\017\192\254','\017\221\253'},{'\017\245\255','\048\246\255','\079\247\255'},
{'\006\011\123','\006\042\122','\006\077\121'},{'\004\060\143','\004\091\142','\004\122\141'},
{'\015\008\248','\015\044\247','\015\075\246'},{'\029\229\255','\060\230\255','\091\231\255'},
{'\000\006\221','\000\037\220','\000\069\219'}}
local all = {}
local function make(k, s, done)
    if k > 13 then all[#all + 1] = s done(#all) return end
    for i = 1, 3 do make(k + 1, B[k][i] .. s, done) end
end
)";

}  // namespace

std::vector<Hostile> hostile_works() {
    const std::string f = "local function f(...) ";
    const std::string list_of = "local t = {} for i = 1, ";
    std::vector<Hostile> all{
        {"TextsOfOneHash", texts_of_one_hash + std::string("make(1, '', function() end)"), ""},
        {"TextsOfOneHashMadeSlowly",
         texts_of_one_hash +
             std::string(
                 "make(1, '', function(n) if n % 50 == 0 then wait_ticks(1) end if n >= 3000 then "
                 "local a, b = all[1]:sub(1, 20), all[1]:sub(21) ") +
             again("local x = a .. b") + " end end)",
         ""},
        {"KeysOfOneHash",
         list_of + "1000 do t[i * 1023] = 1 end local k, x = 1023 " + again("x = t[k]"),
         ""},
        {"FewKeysOfOneHash",
         list_of + "64 do t[i * 63] = 1 end local k, x = 63 " + again("x = t[k]"),
         ""},
        {"FunctionsThatHoldMuch",
         "local " + variables(190) + " " +
             again("do local function f() return " + variables(190) + " end end", 20),
         ""},
        {"FunctionsThatHoldFreshVariables",
         "while true do local " + variables(150) + " do local function f() return " +
             variables(150) + " end end end",
         ""},
        {"Functions", again("do local function f() end end"), ""},
        {"Tables", "local a " + again("a = {}"), ""},
        {"TablesWithKeys", "local a " + again("a = { a = 1, b = 2, c = 3, d = 4 }"), ""},
        {"TablesInALargeHeap",
         list_of + "400000 do t[i] = {} end wait_ticks(1) local a " + again("a = {}"),
         ""},
        {"FullMemory", list_of + "9 do for j = 1, 1e9 do t[j] = {} end end", "64 MB of memory"},
        {"LinkedList", "local t " + again("t = { t }"), "64 MB of memory"},
        {"ManyArguments",
         f + "local s = select " + again("s('#', ...)", 50) + " end f(" + times(240, "1, ") + "1)",
         ""},
        {"ManyArgumentsPassedOn",
         "local function g(...) end " + f + again("g(...)", 50) +
             " end f(table.unpack({}, 1, 450))",
         ""},
        {"ChainOfIndices",
         list_of + "15 do t = setmetatable({}, { __index = t }) end local x " + again("x = t.x"),
         ""},
        {"ChainOfNewIndices",
         list_of + "15 do t = setmetatable({}, { __newindex = t }) end " + again("t.x = nil"),
         ""},
        {"Metamethods",
         "local t = setmetatable({}, { __add = function() end }) local x " + again("x = t + t"),
         ""},
        {"TasksThatCompareLongTexts",
         "local a, b = ('x'):rep(60000) .. 'y', ('x'):rep(60000) .. 'y' local function g() local "
         "x " +
             times(900, "x = a == b ") +
             "end while true do for i = 1, 1900 do start(g) end wait_ticks(1) end",
         ""},
        {"TasksThatWaitForOneTick",
         "local go = false for k = 1, 4 do for i = 1, 490 do start(function() while not go do "
         "wait_ticks(1) end for j = 1, 900 do end end) end wait_ticks(1) end go = true "
         "wait_ticks(1) while true do end",
         ""},
        {"CaughtErrors", "local f, g = pcall, error " + again("f(g)"), ""},
        {"CaughtMistakes", "local f, g = pcall, function() return spwan end " + again("f(g)"), ""},
        {"DeepCalls",
         "local function r(n) if n > 0 then r(n - 1) end return 1 end while true do r(4900) end",
         ""},
        {"EndlessCalls",
         "local function r() return 1 + r() end r()",
         "calls are nested too deeply"},
        {"Sort",
         list_of + "20000 do t[i] = i * 7919 % 20011 end while true do table.sort(t) end",
         ""},
        {"SortThatContradictsItself",
         list_of +
             "20000 do t[i] = i end while true do table.sort(t, function() return true end) end",
         ""},
        {"SortByMetamethod",
         "local t, m = {}, { __lt = function() end } for i = 1, 2000 do t[i] = setmetatable({}, m) "
         "end while true do table.sort(t) end",
         ""},
        {"InsertInFront",
         list_of +
             "60000 do t[i] = i end while true do table.insert(t, 1, 1) table.remove(t, 1) end",
         ""},
        {"MoveOfNothing", "while true do table.move({}, 1, 900000, 2) end", ""},
        {"Unpack", "local t = {} " + again("table.unpack(t, 1, 240)", 20), ""},
        {"NextInAnEmptiedTable",
         list_of + "60000 do t['k' .. i] = 1 end for i = 1, 60000 do t['k' .. i] = nil end while "
                   "true do next(t) end",
         ""},
        {"LengthOfHoles", list_of + "60000 do t[i + 0.5] = 1 end local x " + again("x = #t"), ""},
        {"Gap",
         "local e = spawn{ model = 'sedan', lane = 'east_1', s = 20 } wait_ticks(2) " +
             again("gap(e, e)"),
         ""},
        {"PickLane", again("pick_lane{}"), ""},
        {"WrongLane", "local s = ('x'):rep(60000) while true do pcall(lane_length, s) end", ""},
    };
    for (Hostile& script : all) {
        script.source = running_lazily(script.source);
        if (script.message.empty())
            script.message = spent_in_a_tick;
    }
    return all;
}

std::vector<Hostile> hostile_texts() {
    const std::string s = "local s = ('a'):rep(60000) ";
    const std::string huge = "local a, b = 1.7e308, 5e-324 local x ";
    std::vector<Hostile> all{
        {"Set", s + "local p = '[' .. ('b'):rep(60000) .. ']' while true do s:find(p) end", ""},
        {"SetOfRanges",
         s + "local p = '[' .. ('b-c'):rep(20000) .. ']*z' while true do s:find(p) end",
         ""},
        {"SetThatIsOptional",
         s + "local p = '^[' .. ('b'):rep(60000) .. ']?a' while true do s:find(p) end",
         ""},
        {"SetToTheLeft",
         s + "local p = '[' .. ('b'):rep(60000) .. ']-z' while true do s:find(p) end",
         ""},
        {"Frontier",
         s + "local p = '%f[' .. ('b'):rep(60000) .. ']' while true do s:find(p) end",
         ""},
        {"Backtracking",
         "local s = ('a'):rep(300) local p = ('a?'):rep(190) .. 'z' while true do s:find(p) end",
         ""},
        {"BackReferences", s + "while true do s:find('(a*)%1%1%1%1z') end", ""},
        {"Balance", "local s = ('('):rep(60000) while true do s:find('%b()') end", ""},
        {"LongPatternOfAShortText",
         "local p = ('b'):rep(60000) .. '*' while true do (''):find(p) end",
         ""},
        {"ReplacementThatGrows",
         s + "local r = ('%0'):rep(32000) while true do pcall(string.gsub, s, '.*', r) end",
         ""},
        {"ReplacementByFunction",
         s + "local f = function() end while true do s:gsub('a', f) end",
         ""},
        {"RemainderOfHugeByTiny", huge + again("x = a % b"), ""},
        {"RemainderByFunction", huge + "local f = math.fmod " + again("f(a, b)"), ""},
        {"PowersBelowNormal", "local a, b = 1.0000001, -7.3e9 local x " + again("x = a ^ b"), ""},
        {"JoinedFloats", "local a = 1e308 / 3 local x " + again("x = a .. a"), ""},
        {"ManyJoinedFloats",
         "local a = 1e308 / 3 local x " + again("x = a" + times(99, " .. a"), 5),
         ""},
        {"TextAsLoopLimit",
         "local a = '9' .. ('7'):rep(250) " + again("for i = 1, a do break end"),
         ""},
        {"HexadecimalAsLoopLimit",
         "local a = '0x1' .. ('7'):rep(1000) .. 'p-1060' " + again("for i = 1, a do break end"),
         ""},
        {"EqualLongTexts",
         "local a, b = ('x'):rep(60000) .. 'y', ('x'):rep(60000) .. 'y' local x " +
             again("x = a == b"),
         ""},
        {"OrderOfZeroBytes",
         "local a, b = ('\\0'):rep(60000), ('\\0'):rep(60000) local x " + again("x = a < b"),
         ""},
        {"LongKeys", "local t = {} local s " + again("s = ('x'):rep(200) s = t[s]", 50), ""},
        {"Quotes", "local s = ('\\0'):rep(10000) while true do string.format('%q', s) end", ""},
        {"FormattedFloats", "local a, f = 1e308 / 3, string.format " + again("f('%.99f', a)"), ""},
        {"Repetition", again("string.rep('x', 60000)", 20), ""},
        {"RepetitionOfNothing", again("string.rep('', 1e18)", 20), ""},
        {"NumberInBaseTwo", "local s = ('1'):rep(60000) while true do tonumber(s, 2) end", ""},
        {"Characters",
         "local s = ('a'):rep(60000) while true do utf8.codepoint(s, 1, 5000) end",
         ""},
        {"PackFormat", "local p = ('!16 '):rep(15000) while true do string.pack(p) end", ""},
        {"JoinedList",
         "local t = {} for i = 1, 16000 do t[i] = 'abc' end while true do pcall(table.concat, t) "
         "end",
         ""},
    };
    for (Hostile& script : all) {
        script.source = running_lazily(script.source);
        script.message = spent_in_a_tick;
    }
    return all;
}

std::vector<Hostile> hostile_asks() {
    const std::string parked =
        "spawn{ model = 'bicycle', driver = 'parked', lane = 'east_1', s = i % 40 * 10, offset = i "
        "// 40 % 25 * 4 - 48 }";
    std::vector<Hostile> all{
        {"ParkedCars",
         "for i = 1, 100000 do " + parked + " if i % 900 == 0 then wait_ticks(1) end end",
         "spawn: more than 1000 actors at a time"},
        {"Autopilots",
         "for i = 1, 1e6 do spawn{ model = 'sedan' } end",
         "spawn: more than 300 actors with the driver 'autopilot', 'manual' or 'external' at a "
         "time"},
        {"ActorsOfOtherPrograms",
         "for i = 1, 1e6 do spawn{ model = 'sedan', driver = 'external' } end",
         "spawn: more than 300 actors with the driver 'autopilot', 'manual' or 'external' at a "
         "time"},
        {"ActorsInOnePlace",
         "for i = 0, 999 do spawn{ model = 'bicycle', driver = 'parked', lane = 'east_1', "
         "s = 20 + i // 8 * 2, offset = i % 8 } end",
         "spawn: more than 12 vehicles within 5 m: they would stand in each other"},
        {"ActorsInOnePlaceOverTime",
         "while true do spawn{ model = 'sedan', driver = 'parked', lane = 'east_1', s = 20 } "
         "wait_ticks(3) end",
         "spawn: 'sedan_2' would stand in 'sedan', which line 2 spawned"},
        {"ActorsThatComeAndGo",
         "while true do local all = {} for i = 1, 500 do all[i] = " + parked +
             " end wait_ticks(2) for i = 1, 500 do all[i]:despawn() end wait_ticks(2) end",
         "spawn: more than 10000 actors in one run"},
        {"Commands",
         "while true do set_weather('clear_noon') end",
         "more than 2000 commands in one tick"},
        {"LongRoute",
         "local e = spawn{ model = 'sedan', lane = 'east_1', s = 20 } local t = {} for i = 1, "
         "60000 do t[i] = 'east_1' end e:set_route(t)",
         "set_route: a route of more than 100 lanes and edges"},
        {"PrintedBytes",
         "local s = ('x'):rep(60000) while true do print(s) end",
         "print: more than 256 kB in one tick"},
        {"PrintedLines",
         "local s = ('\\n'):rep(60000) while true do print(s) end",
         "print: more than 1000 lines in one tick"},
        {"Checks",
         "for i = 1, 1e6 do check.never('c' .. i, tick) end",
         "check.never: more than 1000 checks"},
        {"Tasks",
         "while true do start(function() wait(9) end) end",
         "start: more than 2000 tasks at a time"},
        {"TasksOverTime",
         "while true do for i = 1, 500 do start(function() wait(1e6) end) end wait_ticks(1) end",
         "start: more than 2000 tasks at a time"},
        {"Streams",
         "local i = 0 while true do i = i + 1 random('s' .. i) end",
         "random: more than 1000 streams"},
        {"LongName",
         "spawn{ model = 'sedan', name = ('x'):rep(60000) }",
         "'name' must have 1 to 100 characters"},
    };
    for (Hostile& script : all)
        script.source = running_lazily(script.source);
    return all;
}

}  // namespace reprise::test
