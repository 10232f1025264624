#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

// Traps of Lua, by their numbers in docs/lua-traps.md: order, identity, and our side of the calls.
namespace reprise::scripting {

using test::mistake;
using test::printed;
using test::running;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

/// `walk(t)`: the keys in the order of pairs.
constexpr const char* walk =
    "local function walk(t) local keys = {} for key in pairs(t) do keys[#keys + 1] = "
    "tostring(key) end return table.concat(keys, ' ') end\n";

}  // namespace

TEST(Trap01, PairsWalksTextsByTheirBytes) {
    EXPECT_THAT(printed(std::string(walk) + R"(
        print(walk{ ego = 1, npc1 = 1, npc2 = 1, ped = 1, truck = 1, bike = 1, cone = 1, signal = 1 })
        local long = {}
        for _, letter in ipairs{ 'f', 'b', 'e', 'a', 'd', 'c' } do long[('x'):rep(50) .. letter] = 1 end
        print((walk(long):gsub('x', ''))))"),
                ElementsAre("bike cone ego npc1 npc2 ped signal truck", "a b c d e f"));
}

TEST(Trap02, KeysWithoutAnOrderAreRefusedByPairsAndNext) {
    for (const char* key : {"{}", "print", "function() end", "spawn{ model = 'sedan' }"})
        for (const char* word : {"pairs", "next"})
            EXPECT_THAT(mistake(std::string(word) + "{ [" + key + "] = 1 }"),
                        HasSubstr("as key has no order"))
                << word << " " << key;
}

TEST(Trap03, TheOrderForgetsHowTheTableCameToBe) {
    EXPECT_THAT(printed(std::string(walk) + R"(
        local keys = { 'ego', 'npc1', 'npc2', 'ped', 'truck', 'bike', 3, 2.5, -7, true }
        local up, down, grown = {}, {}, {}
        for i = 1, #keys do up[keys[i]] = 1 end
        for i = #keys, 1, -1 do down[keys[i]] = 1 end
        for i = 1, 500 do grown['k' .. i] = 1 end
        for i = 1, #keys do grown[keys[i]] = 1 end
        for i = 1, 500 do grown['k' .. i] = nil end
        print(walk(up) == walk(down), walk(up) == walk(grown), walk(up)))"),
                ElementsAre("true true -7 2.5 3 bike ego npc1 npc2 ped truck true"));
}

TEST(Trap04, NumbersComeAscendingWhateverThisReleasesHash) {
    EXPECT_THAT(printed(std::string(walk) + R"(
        local t = {}
        for i = 1, 12 do t[i * 37 % 101 - 50] = i; t[i * 0.37] = i end
        local last, good, count = -1 / 0, true, 0
        for key in pairs(t) do good = good and key > last; last = key; count = count + 1 end
        print(good, count)
        print(walk{ [1 << 62] = 1, [2.0 ^ 63] = 1, [-(2.0 ^ 70)] = 1, [math.mininteger] = 1 }))"),
                ElementsAre("true 24",
                            "-1180591620717411303424.0 -9223372036854775808 4611686018427387904 "
                            "9223372036854775808.0"));
}

TEST(Trap05, AWalkSeesTheKeysOfItsStartThatAreStillThere) {
    EXPECT_THAT(
        printed("local t, seen = { a = 1, b = 2, c = 3 }, '' "
                "for key in pairs(t) do seen = seen .. key; t.b = nil; t[key .. key] = 1 end "
                "print(seen)"),
        ElementsAre("ac"));
}

// Documented: a list with holes has any of its borders as size. The same one in every process.
TEST(Trap06, TheSizeOfAListWithHolesIsABorderAndTheSameInEqualRuns) {
    const std::string body = running(
        "local a = {} for i = 1, 10 do a[i] = i end a[5] = nil a[10] = nil "
        "local b = {} b[1] = 1 b[2] = 2 b[4] = 4 local n = #a "
        "print(#a, #b, a[#a] ~= nil and a[#a + 1] == nil)");
    test::Stage one(body);
    test::Stage two(body);
    EXPECT_EQ(one.play(1), two.play(1));
    EXPECT_THAT(one.events.at(0).text, testing::EndsWith("true"));
    EXPECT_EQ(one.digests, two.digests);
}

TEST(Trap11, SortKeepsTheOrderOfTies) {
    EXPECT_THAT(printed(R"(
        for _, size in ipairs{ 99, 101, 4000 } do
            for _, rank in ipairs{ function(i) return i % 3 end,
                                   function(i) return i < size // 2 and i or size - i end,
                                   function(i) return i > size - 3 and 0 or i // 10 end,
                                   function() return 0 end } do
                local list = {}
                for i = 1, size do list[i] = { rank = rank(i), place = i } end
                table.sort(list, function(a, b) return a.rank < b.rank end)
                for i = 2, size do
                    local a, b = list[i - 1], list[i]
                    assert(a.rank < b.rank or (a.rank == b.rank and a.place < b.place))
                end
            end
        end
        print 'stable')"),
                ElementsAre("stable"));
}

TEST(Trap12, AnOrderThatContradictsItselfLosesNoElement) {
    EXPECT_THAT(printed(R"(
        for _, order in ipairs{ function(a, b) return a <= b end, function() return true end,
                                function(a, b) return a % 3 < b % 2 end } do
            local list, seen, count = {}, {}, 0
            for i = 1, 300 do list[i] = i * 7 % 300 end
            table.sort(list, order)
            for _, value in ipairs(list) do seen[value] = true end
            for _ in pairs(seen) do count = count + 1 end
            print(#list, count)
        end)"),
                ElementsAre("300 300", "300 300", "300 300"));
}

TEST(Trap26, TasksGoOnInTheOrderOfTheirStart) {
    EXPECT_THAT(printed(R"(
        for i = 1, 4 do
            start(function() wait_ticks(5 - i) print(tick(), i) wait_ticks(i) print(tick(), i) end)
        end
        wait_ticks(6))"),
                ElementsAre("1 4", "2 3", "3 2", "4 1", "5 1", "5 2", "5 3", "5 4"));
}

TEST(Trap27, CloseVariablesRunBackwardsAndTheLastErrorCounts) {
    EXPECT_THAT(printed(R"(
        local function closing(name, message)
            return setmetatable({}, { __close = function() print(name) if message then error(message, 0) end end })
        end
        print(pcall(function()
            local a <close> = closing('a', 'from a')
            local b <close> = closing('b')
            error('first', 0)
        end)))"),
                ElementsAre("b", "a", "false from a"));
    // A task that never goes on is dropped without them.
    test::Stage stage(
        running("start(function() local t <close> = setmetatable({}, { __close = "
                "function() print 'closed' end }) wait(9) end) wait_ticks(2)"));
    EXPECT_THAT(stage.play(10), ElementsAre());
}

TEST(Trap37, AnActorHasOneHandle) {
    EXPECT_THAT(printed(R"(
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 20 }
        local other = spawn{ name = 'other', model = 'sedan', lane = 'east_2', s = 20 }
        local list = { [ego:id()] = ego }
        wait_ticks(2)
        print(list[1] == ego, list[1] == other, tostring(ego), rawequal(list[1], ego)))"),
                ElementsAre("true false ego true"));
}

TEST(Trap38, WhatCppHandsToLuaIsSortedAndItsChanceIsOurs) {
    // Of several mistakes in one table the same is named in every run.
    for (int repeat = 0; repeat < 5; ++repeat)
        EXPECT_THAT(mistake("spawn{ zeta = 1, alpha = 1, model = 'sedan', beta = 1 }"),
                    HasSubstr("unknown key 'alpha'"));
    // Counter-based: a draw in one stream moves nothing in another.
    const auto two = printed("print(random('a')) print(random('b'))");
    EXPECT_EQ(printed("random('b') print(random('a'))").at(0), two.at(0));
    EXPECT_EQ(printed("random('a') random() print(random('b'))").at(0), two.at(1));
}

/// Once a tick, in advance(): neither when the file is read, nor between steps, nor in the last
/// word that checks have, nor after its end. What it said once stays as it was.
TEST(Trap39, AScenarioSpeaksInItsStepOnly) {
    for (const char* word : {"print('x')",
                             "spawn{ model = 'sedan' }",
                             "finish()",
                             "wait(1)",
                             "check.never('x', function() end)",
                             "set_weather 'clear_noon'"})
        EXPECT_NE(test::mistake_in_file(std::string(word) +
                                        "\nreturn scenario 'x' { run = function() end }"),
                  "")
            << word << ": said while the file is read";

    test::Stage stage(running(R"(
        check.at_end('end', function() return tick() > 0 end)
        start(function() while true do print(tick()) wait_ticks(1) end end)
        wait_ticks(3)
        finish('done'))"));
    const std::uint64_t unread = stage.scenario.digest();
    EXPECT_EQ(stage.scenario.checks().size(), 0U) << "nothing runs before the first step";
    EXPECT_EQ(stage.scenario.digest(), unread);
    const auto printed_in = [&] {
        std::vector<std::string> lines;
        for (const world::EventT& event : stage.step().tick.events)
            lines.push_back(event.text);
        return lines;
    };
    for (const char* line : {"0", "1", "2"}) {
        EXPECT_THAT(printed_in(), testing::ElementsAre(line));
        const std::uint64_t between = stage.scenario.digest();
        EXPECT_EQ(stage.scenario.checks().size(), 1U);
        EXPECT_EQ(stage.scenario.digest(), between) << "asking runs nothing";
    }
    EXPECT_TRUE(stage.step().tick.events.empty()) << "finish is the last word, also of other tasks";
    EXPECT_EQ(stage.reason(), "done");
    const std::size_t said = stage.events.size();
    stage.conclude();
    ASSERT_EQ(stage.events.size(), said + 1) << "the check's verdict, and no task's line";
    EXPECT_EQ(stage.events.back().kind, world::EventKind::check_passed);
    const std::uint64_t after = stage.scenario.digest();
    EXPECT_TRUE(stage.step().tick.events.empty()) << "nothing runs after the end";
    EXPECT_EQ(stage.scenario.digest(), after);
}

TEST(Trap41, WhatIsSaidTakesEffectInTheNextTick) {
    EXPECT_THAT(printed(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20, speed = 5 }
        ego:speed()
        local before = ego:speed()
        ego:set_speed(9)
        local same = ego:speed()
        start(function() print('task', ego:speed()) end)
        ego:despawn()
        print(before, same, ego:exists())
        wait_ticks(1)
        print(ego:exists()))"),
                ElementsAre("5.0 5.0 true", "task 5.0", "false"));
}

}  // namespace reprise::scripting
