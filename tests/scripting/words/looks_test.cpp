// Words that look around, on a straight road of two lanes a side: east_1 is the right one (its
// centre line at y = -5.25), east_2 the left one (-1.75), west_2 the nearest of the other direction
// (1.75). A sedan is 4.70 m long, 1.82 m wide, and reaches 1.00 m behind its position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

using test::mistake;
using test::printed;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

/// An ego at x = 100 on east_1; then this.
std::string with_ego(const std::string& body) {
    return "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'east_1', "
           "s = 100 }\n" +
           body;
}

}  // namespace

TEST(Around, ListsEverybodyByDistanceAndThenById) {
    EXPECT_THAT(printed(with_ego(R"(
        spawn{ name = 'far', model = 'sedan', driver = 'parked', lane = 'east_1', s = 130 }
        spawn{ name = 'b', model = 'child', lane = 'east_1', s = 110, offset = 3 }
        spawn{ name = 'a', model = 'child', lane = 'east_1', s = 110, offset = -3 }
        spawn{ name = 'bike', model = 'bicycle', driver = 'traffic', lane = 'east_2', s = 90 }
        spawn{ name = 'beyond', model = 'sedan', lane = 'east_1', s = 170 }
        wait_ticks(1)
        local function names(list)
            local all = {}
            for i, each in ipairs(list) do all[i] = each.name end
            return table.concat(all, ' ')
        end
        print(names(ego:around(60)))
        print(names(ego:around(10)), '-', names(ego:around(0)))
        print(names(ego:around(60, { kind = 'walker' })), '-', names(ego:around(60, { kind = 'bicycle' })),
              '-', names(ego:around(60, { kind = 'vehicle' }))))")),
                ElementsAre("b a bike far", "b a - ", "b a - bike - far"))
        << "equally far: the one that was spawned first";
}

TEST(Around, TellsOfEachWhoAndWhereItIs) {
    EXPECT_THAT(printed(with_ego(R"(
        local lead = spawn{ name = 'lead', model = 'sedan', driver = 'manual', lane = 'east_2', s = 120, speed = 10 }
        wait_ticks(2)
        local it = ego:around(60)[1]
        print(it.name, it.kind, it.model, it.driver, it.id, it.lane, it.length, it.width, it.speed)
        print(it.x, it.y, it.heading_deg, it.s, it.x == lead:x(), it.s == lead:s())
        print(string.format('%.3f %.3f %.3f', it.ahead, it.left, it.distance), it.distance == distance(ego, lead)))")),
                ElementsAre("lead vehicle sedan manual 2 east_2 4.7 1.82 10.0",
                            "121.0 -1.75 0.0 121.0 true true",
                            "21.000 3.500 21.290 true"));
}

TEST(Around, SeesFromTheOwnHeading) {
    EXPECT_THAT(printed(R"(
        local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'west_2', s = 300 }
        spawn{ name = 'oncoming', model = 'sedan', driver = 'manual', lane = 'east_2', s = 80 }
        wait_ticks(1)
        local it = ego:around(60)[1]
        print(string.format('%.3f %.3f %.0f', it.ahead, it.left, it.heading_deg)))"),
                ElementsAre("17.300 3.500 0"))
        << "20 m between the axles, whose bodies reach 1.35 m ahead of the middle";
}

TEST(Around, NobodyIsOffEveryLaneWithALane) {
    EXPECT_THAT(printed(with_ego(R"(
        spawn{ model = 'child', lane = 'east_0', s = 100, offset = -20 }
        spawn{ model = 'child', lane = 'east_0', s = 101 }
        wait_ticks(1)
        local near = ego:around(60)
        print(near[1].lane, near[1].s, near[2].lane, near[2].s))")),
                ElementsAre("east_0 101.0 nil nil"));
}

TEST(GapAheadWord, IsToWhateverIsInTheOwnStrip) {
    EXPECT_THAT(printed(with_ego(R"(
        spawn{ name = 'beside', model = 'sedan', driver = 'parked', lane = 'east_2', s = 110 }
        spawn{ name = 'lead', model = 'sedan', driver = 'parked', lane = 'east_1', s = 150 }
        spawn{ name = 'behind', model = 'sedan', driver = 'parked', lane = 'east_1', s = 80 }
        wait_ticks(1)
        local gap, name, kind = ego:gap_ahead()
        print(string.format('%.3f', gap), name, kind))")),
                ElementsAre("45.300 lead vehicle"))
        << "150 - 1.00 - (100 + 3.70)";
}

TEST(GapAheadWord, CountsWhoReachesIntoTheStrip) {
    // The strips are 1.82 m wide: apart from 1.82 m on, whoever stands there.
    for (const auto& [offset, answer] :
         {std::pair("1.75", "25.300 it"), {"1.9", "nil nil"}, {"-1.75", "25.300 it"}})
        EXPECT_THAT(printed(with_ego("spawn{ name = 'it', model = 'sedan', driver = 'parked', "
                                     "lane = 'east_1', s = 130, offset = " +
                                     std::string(offset) +
                                     " } wait_ticks(1) local gap, name = ego:gap_ahead() "
                                     "print(gap and string.format('%.3f', gap), name)")),
                    ElementsAre(answer));
}

TEST(GapAheadWord, SeesWalkersAndIsNilWhenTheWayIsClear) {
    EXPECT_THAT(printed(with_ego(R"(
        print(ego:gap_ahead())
        local child = spawn{ name = 'child', model = 'child', lane = 'east_1', s = 120 }
        wait_ticks(2)
        local gap, name, kind = ego:gap_ahead()
        print(gap > 16 and gap < 16.3, name, kind)
        check.min('gap', function() return ego:gap_ahead() end, 1))")),
                ElementsAre("nil", "true child walker"));
}

TEST(GapAheadWord, LooksTwoHundredMetresFar) {
    EXPECT_THAT(
        printed(
            "local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', s = 10 } "
            "spawn{ name = 'it', model = 'sedan', driver = 'parked', lane = 'east_1', s = 214.6 } "
            "spawn{ name = 'other', model = 'sedan', driver = 'parked', lane = 'east_2', s = 214.8 "
            "} "
            "local left = spawn{ model = 'sedan', driver = 'manual', lane = 'east_2', s = 10 } "
            "wait_ticks(1) print(select(2, ego:gap_ahead()), left:gap_ahead())"),
        ElementsAre("it nil"));
}

TEST(LateralGap, IsBetweenTheOutlinesAcrossTheOwnHeading) {
    EXPECT_THAT(printed(with_ego(R"(
        local bike = spawn{ model = 'bicycle', driver = 'manual', lane = 'east_1', s = 200, offset = -1.5 }
        local beside = spawn{ model = 'sedan', driver = 'manual', lane = 'east_2', s = 100 }
        local across = spawn{ model = 'child', lane = 'east_1', s = 150 }
        wait_ticks(1)
        print(string.format('%.2f %.2f %.2f', ego:lateral_gap(bike), ego:lateral_gap(beside), beside:lateral_gap(ego)))
        print(ego:lateral_gap(across) < 0, ego:lateral_gap(ego)))")),
                ElementsAre("0.28 1.68 1.68", "true -1.82"))
        << "1.5 - 0.91 - 0.31; 3.5 - 1.82";
}

TEST(Offset, IsFromANamedLaneToo) {
    EXPECT_THAT(printed(R"(
        local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', s = 100, offset = 0.4 }
        wait_ticks(1)
        print(string.format('%.2f %.2f %.2f %.2f', ego:offset(), ego:offset 'east_1', ego:offset 'east_2', ego:offset 'west_2')))"),
                ElementsAre("0.40 0.40 -3.10 6.60"))
        << "left of west_2's driving direction is south";
}

TEST(TtcOnOneLane, IsInfiniteForWhoIsOnAnotherLane) {
    EXPECT_THAT(printed(R"(
        local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', s = 100, speed = 20 }
        local lead = spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', s = 150, speed = 10 }
        local left = spawn{ model = 'sedan', driver = 'manual', lane = 'east_2', s = 160, speed = 10 }
        wait_ticks(1)
        local one = { same_lane = true }
        print(ttc(ego, lead, one) == ttc(ego, lead), ttc(ego, left) < 6, ttc(ego, left, one), ttc(ego, left, {}) < 6))"),
                ElementsAre("true true inf true"));
}

TEST(TtcOnOneLane, CountsWhoReachesThirtyCentimetresIn) {
    // Half of a lane and of a car: 1.75 + 0.91 = 2.66 m from the middle of the other lane, 3.5 m
    // away.
    for (const auto& [offset, counts] : {std::pair("-1.10", "false"), {"-1.17", "true"}})
        EXPECT_THAT(
            printed("local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', "
                    "s = 100, speed = 20 } "
                    "local left = spawn{ model = 'sedan', driver = 'manual', lane = 'east_2', "
                    "s = 160, offset = " +
                    std::string(offset) +
                    " } wait_ticks(1) "
                    "print(ttc(ego, left, { same_lane = true }) < 100)"),
            ElementsAre(counts));
}

TEST(RouteCompletion, IsNilWithoutARouteAndTheShareOfTheWayWithOne) {
    EXPECT_THAT(printed(R"(
        local ego = spawn{ model = 'sedan', lane = 'east_1', s = 100, speed = 20 }
        wait_ticks(1)
        print(ego:route_completion())
        ego:route_to{ lane = 'east_1', s = 121 }
        print(ego:route_completion())
        for _ = 1, 3 do wait(0.25) print(string.format('%.3f', ego:route_completion())) end
        wait(0.1)
        print(ego:route_completion()))"),
                ElementsAre("nil", "0.0", "0.250", "0.500", "0.750", "1.0"))
        << "20 m of way, 5 m each; it arrives when its bumper does";
}

TEST(Looks, AreRefusedWhereTheyMeanNothing) {
    const std::string child =
        "local it = spawn{ name = 'it', model = 'child', lane = 'east_0', s = 3 }\n";
    for (const char* word :
         {"gap_ahead", "ran_red", "route_completion", "left_road", "on_opposite_lane"})
        EXPECT_EQ(
            mistake(child + "it:" + word + "()"),
            "test.lua:2: " + std::string(word) + ": 'it' is a walker: only vehicles have that");
    const std::string bus =
        "local it = spawn{ name = 'it', model = 'bus', driver = 'traffic', lane = 'east_1', s = 90 "
        "}\n";
    for (const char* word : {"left_road", "on_opposite_lane"})
        EXPECT_EQ(
            mistake(bus + "it:" + word + "()"),
            "test.lua:2: " + std::string(word) +
                ": 'it' has driver = 'traffic', which never leaves its lane: only 'autopilot', "
                "'manual' and 'external' can");
}

TEST(Looks, SayWhatIsWrong) {
    const auto wrong = [](const std::string& body) { return mistake(with_ego(body)); };
    EXPECT_EQ(wrong("ego:around()"),
              "test.lua:2: around: the distance must be a number, got nothing");
    EXPECT_EQ(wrong("ego:around(-1)"), "test.lua:2: around: the distance must be in [0, 1000] m");
    EXPECT_EQ(
        wrong("ego:around(9, { kind = 'walkers' })"),
        "test.lua:2: around: no kind 'walkers' (did you mean 'walker'?): 'vehicle', 'bicycle', "
        "'walker' or 'prop'");
    EXPECT_EQ(wrong("ego:around(9, { knd = 'walker' })"),
              "test.lua:2: around: unknown key 'knd' (did you mean 'kind'?)");
    EXPECT_THAT(wrong("ego:lateral_gap()"),
                HasSubstr("test.lua:2: lateral_gap: an actor is needed as argument 2"));
    EXPECT_EQ(wrong("ego:offset 'east_3'"),
              "test.lua:2: no lane 'east_3' in straight_road (did you mean 'east_1'?)");
    EXPECT_EQ(wrong("ego:offset(3)"), "test.lua:2: offset: the lane must be a string, got 3");
    EXPECT_EQ(wrong("ttc(ego, ego, { same_lain = true })"),
              "test.lua:2: ttc: unknown key 'same_lain' (did you mean 'same_lane'?)");
    EXPECT_EQ(wrong("ttc(ego, ego, { same_lane = 1 })"),
              "test.lua:2: ttc: 'same_lane' must be true or false, got 1");
    EXPECT_EQ(wrong("ego:ran_reds()"),
              "test.lua:2: an actor has no 'ran_reds' (did you mean 'ran_red'?)");
}

TEST(Looks, AreAllowedInChecksAndConditions) {
    EXPECT_EQ(mistake(with_ego(R"(
        check.never('a', function() return #ego:around(9) > 0 end)
        check.min('b', function() return ego:gap_ahead() end, 1, { optional = true })
        check.never('c', function() return ego:ran_red() end)
        check.max('d', function() return ego:route_completion() end, 1, { optional = true })
        check.never('e', function() return ego:left_road() or ego:on_opposite_lane() end)
        check.max('f', function() return ego:offset 'east_1' end, 1)
        wait_until(function() return ego:ran_red() end, { timeout = 0.5 }))")),
              "");
}

}  // namespace reprise::scripting
