#include "scripting/run/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"

namespace reprise::scripting {

using Check = world::CheckResult;
using Status = Check::Status;
using testing::ElementsAre;

namespace {

/// The checks after this body ran for so many ticks, concluded.
std::vector<Check> concluded(const std::string& body, int ticks = 40) {
    test::Stage stage(test::running(body));
    stage.play(ticks);
    stage.conclude();
    return stage.scenario.checks();
}

Status status_of(const std::string& body) {
    return concluded(body).at(0).status;
}

}  // namespace

TEST(Checks, NeverFailsInTheTickBehindThatInWhichItHappened) {
    const auto checks =
        concluded("\ncheck.never('early', function() return tick() == 4 end) wait(1)");
    ASSERT_EQ(checks.size(), 1U);
    EXPECT_EQ(checks[0].status, Status::fail);
    EXPECT_EQ(checks[0].tick, 5U) << "which holds the event";
    EXPECT_EQ(checks[0].line, 2U);
    EXPECT_EQ(checks[0].detail, "it happened");
}

TEST(Checks, AreEvaluatedFromTheTickAfterTheyWereRegistered) {
    EXPECT_EQ(status_of("check.never('zero', function() return tick() == 0 end) wait(1)"),
              Status::pass);
    EXPECT_EQ(status_of("check.never('one', function() return tick() == 1 end) wait(1)"),
              Status::fail);
}

TEST(Checks, EveryKindPassesAndFails) {
    const std::string late = "function() return tick() >= 10 end";
    EXPECT_EQ(status_of("check.always('a', function() return tick() < 30 end) wait(1)"),
              Status::pass);
    EXPECT_EQ(status_of("check.always('a', function() return tick() < 5 end) wait(1)"),
              Status::fail);
    EXPECT_EQ(status_of("check.max('a', tick, 25) wait(1)"), Status::pass);
    EXPECT_EQ(status_of("check.max('a', tick, 15) wait(1)"), Status::fail);
    EXPECT_EQ(status_of("check.min('a', tick, 1) wait(1)"), Status::pass);
    EXPECT_EQ(status_of("check.min('a', tick, 2) wait(1)"), Status::fail);
    EXPECT_EQ(status_of("check.eventually('a', " + late + ") wait(1)"), Status::pass);
    EXPECT_EQ(status_of("check.eventually('a', " + late + ", { within = 0.5 }) wait(1)"),
              Status::pass);
    EXPECT_EQ(status_of("check.eventually('a', " + late + ", { within = 0.4 }) wait(1)"),
              Status::fail);
    EXPECT_EQ(status_of("check.eventually('a', function() end) wait(1)"), Status::fail);
    EXPECT_EQ(status_of("check.at_end('a', " + late + ") wait(1)"), Status::pass);
    EXPECT_EQ(status_of("check.at_end('a', function() return tick() < 5 end) wait(1)"),
              Status::fail);
}

TEST(Checks, WhatWasNeverEvaluatedDidNotPass) {
    const std::string absent =
        "local ego = spawn{ model = 'sedan' } ego:despawn() wait_ticks(2) "
        "check.never('a', function() return ego:speed() > 3 end";
    EXPECT_EQ(status_of(absent + ") wait(1)"), Status::not_evaluated);
    EXPECT_EQ(status_of(absent + ", { optional = true }) wait(1)"), Status::pass);
    EXPECT_EQ(status_of("check.max('nothing to measure', function() end, 3) wait(1)"),
              Status::not_evaluated);
}

TEST(Checks, AnActorThatIsNotYetThereIsNoMistake) {
    EXPECT_EQ(status_of("local ego check.always('a', function() return ego:speed() >= 0 end) "
                        "ego = spawn{ model = 'sedan' } wait(1)"),
              Status::pass);
    // Not even when the predicate tries to hide it.
    EXPECT_EQ(
        status_of("local ego = spawn{ model = 'sedan' } ego:despawn() wait_ticks(2) "
                  "check.always('a', function() pcall(ego.speed, ego) return false end) wait(1)"),
        Status::not_evaluated);
}

TEST(Checks, StopEndsTheRun) {
    test::Stage stage(test::running(
        "check.max('late', tick, 3, { stop = true }) check.max('very late', tick, 99) wait(1)"));
    stage.play(40);
    EXPECT_EQ(stage.reason(), "check failed: late");
    EXPECT_EQ(stage.digests.size(), 5U);
}

TEST(Checks, TheLastTickCounts) {
    test::Stage stage(
        test::running("local ego = spawn{ model = 'sedan' } "
                      "check.never('collision', function() return ego:collided() end) "
                      "wait_ticks(5) finish 'done'"));
    for (int i = 0; i < 5; ++i)
        stage.step();
    stage.collide(1, 0);  // in the tick in which the scenario finishes
    stage.step();
    EXPECT_EQ(stage.reason(), "done");
    EXPECT_EQ(stage.scenario.checks().at(0).status, Status::not_evaluated);
    stage.conclude();
    EXPECT_EQ(stage.scenario.checks().at(0).status, Status::fail);
    EXPECT_EQ(stage.scenario.checks().at(0).tick, 6U);
}

TEST(Checks, NeverBlockedNeedsNoFunctionAndFailsWhenAVehicleStandsForAMinute) {
    test::Stage stage(
        test::running("spawn{ model = 'sedan' }\ncheck.never('blocked', { stop = true }) wait(9)"));
    const std::uint64_t minute = 60 * 20;  // ticks
    stage.halt(1, minute - 1);
    stage.play(5);
    EXPECT_EQ(stage.scenario.checks().at(0).status, Status::not_evaluated) << "not decided yet";
    stage.halt(1, minute);
    stage.play(2);
    const Check check = stage.scenario.checks().at(0);
    EXPECT_EQ(check.status, Status::fail);
    EXPECT_EQ(check.line, 2U);
    EXPECT_EQ(stage.reason(), "check failed: blocked");
    EXPECT_THAT(check.detail, testing::StartsWith("actor 1 since "));
}

TEST(Checks, NeverBlockedPassesWhoMovesAndSaysWhenThereWasNobody) {
    test::Stage stage(
        test::running("spawn{ model = 'sedan' } check.never('blocked') wait_ticks(5) finish()"));
    stage.halt(1, 0);
    stage.play(40);
    stage.conclude();
    EXPECT_EQ(stage.scenario.checks().at(0).status, Status::pass);
    EXPECT_EQ(status_of("check.never('blocked') wait(1)"), Status::not_evaluated);
}

TEST(Checks, NeverBlockedWithAFunctionAsksTheFunction) {
    EXPECT_EQ(status_of("check.never('blocked', function() return tick() == 4 end) wait(1)"),
              Status::fail);
}

TEST(Checks, NoOtherNameDoesWithoutAFunction) {
    EXPECT_THAT(test::mistake("check.never('Blocked')"), testing::HasSubstr("a function"));
    EXPECT_THAT(test::mistake("check.always('blocked')"), testing::HasSubstr("a function"));
}

TEST(Checks, AreRecordedAsEvents) {
    test::Stage stage(
        test::running("check.max('ego: speed', tick, 6)\ncheck.min('tick', tick, 0) "
                      "check.max('no value', function() end, 1) wait_ticks(20)"));
    stage.play(40);
    stage.conclude();
    std::vector<std::string> seen;
    for (const world::EventT& event : stage.events)
        seen.push_back(std::string(world::EnumNameEventKind(event.kind)) + " " +
                       std::to_string(event.line) + " " + event.text + "|" + event.detail);
    EXPECT_THAT(seen,
                ElementsAre("check_failed 1 ego: speed|7 is more than 6",
                            "check_failed 1 ego: speed|worst 21 at 1.05 s",
                            "check_passed 2 tick|at least 1 at 0.05 s, allowed 0",
                            "not_evaluated 2 no value|nothing to look at"));
    EXPECT_EQ(stage.events[0].value, 7);
}

TEST(Checks, SayTheirWorstValueAndWhenNotOnlyTheFirst) {
    // 4, 5, ... 9 in tick 9, then down again.
    const std::string hill = "function() local t = tick() return t <= 9 and t or 18 - t end";
    Check check = concluded("check.max('a', " + hill + ", 6) wait(1)").at(0);
    EXPECT_EQ(check.tick, 8U);
    EXPECT_EQ(check.detail, "7 is more than 6");
    EXPECT_EQ(check.worst, "worst 9 at 0.45 s");
    check = concluded("check.max('a', " + hill + ", 9) wait(1)").at(0);
    EXPECT_EQ(check.detail, "at most 9 at 0.45 s, allowed 9");
    EXPECT_EQ(check.worst, "");
    check = concluded("check.min('a', " + hill + ", 1.5) wait(1)").at(0);
    EXPECT_EQ(check.detail, "1 is less than 1.5");
    EXPECT_EQ(check.worst, "worst -3 at 1.05 s");
}

TEST(Checks, SayForHowLongWhatMustNotBeWasSo) {
    const std::string some = "function() local t = tick() return t == 4 or t >= 8 and t < 12 end";
    Check check = concluded("check.never('a', " + some + ") wait(1)").at(0);
    EXPECT_EQ(check.tick, 5U);
    EXPECT_EQ(check.detail, "it happened");
    EXPECT_EQ(check.worst, "worst 0.25 s in all, until 0.55 s");
    check = concluded("check.always('a', function() return tick() ~= 5 end) wait(1)").at(0);
    EXPECT_EQ(check.worst, "") << "once: that was all";
}

TEST(Checks, StopWhereTheRunEndsAnywayIsAMistake) {
    EXPECT_THAT(test::mistake("check.at_end('a', print, { stop = true })"),
                testing::HasSubstr("'stop' has no effect"));
    EXPECT_THAT(test::mistake("check.eventually('a', print, { stop = true })"),
                testing::HasSubstr("give it 'within'"));
}

TEST(Checks, ConcludingTwiceSaysNothingTwice) {
    test::Stage stage(test::running("check.always('a', function() return true end) wait(1)"));
    stage.play(40);
    stage.conclude();
    const std::size_t count = stage.events.size();
    stage.conclude();
    EXPECT_EQ(stage.events.size(), count);
}

TEST(Checks, MayLookButNotAct) {
    for (const char* act : {"wait(1)",
                            "spawn{ model = 'sedan' }",
                            "finish()",
                            "ego:set_speed(3)",
                            "random()",
                            "start(print)",
                            "wait_until(function() end)"})
        EXPECT_EQ(test::mistake(std::string("local ego = spawn{ model = 'sedan' } "
                                            "check.never('x', function()\n") +
                                act + " end) wait(1)"),
                  "test.lua:2: a check may look, but not act or wait")
            << act;
}

}  // namespace reprise::scripting
