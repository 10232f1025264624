// Runs with drivers in other programs, whole, and what can be done with their traces without them.
#include "tests/cli/drivers.h"

#include <csignal>
#include <cstdlib>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include "world/random.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class OneDriver : public Drivers, public testing::WithParamInterface<const char*> {
  protected:
    std::string driver() const {
        return GetParam() == std::string("Python") ? python_driver : odd_driver + " steady";
    }
};

TEST_P(OneDriver, DrivesARunThatVerifiesAndIsTheSameOnceMore) {
    EXPECT_THAT(drive("one", driver(), "a.mcap"), HasSubstr("completed: time limit"));
    expect_equal("a.mcap", 100);
    drive("one", driver(), "b.mcap");
    EXPECT_TRUE(bytes("a.mcap") == bytes("b.mcap"));
    replay::TraceReader trace(folder_ / "a.mcap");
    EXPECT_GT(trace.tick(100).view.vehicles()[0].odometer(), 3) << "it drove";
}

TEST_P(OneDriver, DrivesTheSameWhetherItPollsOrSleeps) {
    drive("one", driver(), "a.mcap");
    const std::string source = read_file(folder_ / "driver.py");
    for (const auto& [habit, polling] : {std::pair("polls", "10"), std::pair("sleeps", "0")}) {
        std::string own = source;
        own.insert(own.rfind(')'), fmt::format(", polling={}", polling));
        write_file(folder_ / "polling.py", own);
        const bool is_python = driver() == python_driver;
        const std::string one = is_python ? PYTHON " -B polling.py" : odd_driver + " " + habit;
        drive("one", one, "b.mcap");
        EXPECT_TRUE(bytes("b.mcap") == bytes("a.mcap")) << habit;
    }
}

TEST_P(OneDriver, IsNotNeededForItsTrace) {
    drive("one", driver(), "a.mcap");
    fs::remove(folder_ / "driver.py");
    const std::vector<std::string> nothing{"PATH=/nonexistent", "PYTHONPATH="};
    EXPECT_THAT(run({"verify", "a.mcap"}, 0, nothing),
                HasSubstr("equal at every one of 100 ticks"));
    run({"render", "a.mcap", "-o", "pictures", "--camera", "depth", "--size", "64x48"}, 0, nothing);
    run({"run", "a.mcap", "-o", "again.mcap"}, 0, nothing);
    EXPECT_TRUE(bytes("again.mcap") == bytes("a.mcap"));
    run({"branch", "a.mcap", "--at", "50t", "--set", "word=bye", "-o", "b.mcap"}, 0, nothing);
    EXPECT_THAT(run({"verify", "b.mcap"}, 0, nothing),
                HasSubstr("equal at every one of 100 ticks"));
}

TEST_P(OneDriver, TraceIsStrippedExpandedAndSliced) {
    drive("one", driver(), "a.mcap");
    for (const std::string level : {"keyed", "core", "inputs"}) {
        run({"strip", "a.mcap", "-o", "s.mcap", "--level", level}, 0);
        expect_equal("s.mcap", 100);
        run({"expand", "s.mcap", "-o", "e.mcap"}, 0);
        EXPECT_TRUE(bytes("e.mcap") == bytes("a.mcap")) << level;
    }
    run({"slice", "a.mcap", "--ticks", "1..40", "-o", "part.mcap"}, 0);
    expect_equal("part.mcap", 40);
}

INSTANTIATE_TEST_SUITE_P(Each, OneDriver, testing::Values("Python", "Cpp"), [](const auto& info) {
    return std::string(info.param);
});

TEST_F(Drivers, TwoAtOnceEachDriveTheirOwn) {
    write_scenario("two", spawn("ego", 40) + "wait(0.5)\n" + spawn("other", 15));
    run({"run",
         "two.lua",
         "--driver",
         "other=" + python_driver,
         "--driver",
         "ego=" + odd_driver + " steady",
         "-o",
         "a.mcap"},
        0);
    expect_equal("a.mcap", 100);
    replay::TraceReader trace(folder_ / "a.mcap");
    const auto controls = trace.tick(30).view.controls();
    ASSERT_EQ(controls.size(), 2U);
    EXPECT_EQ(controls[0].steer(), 0.125);
    EXPECT_EQ(controls[1].steer(), -0.01);
}

TEST_F(Drivers, OneThatRunsAlreadyComesToASocket) {
    // The socket appears some time after the run began: the driver comes until it is let in.
    const Result result =
        typed("reprise run one.lua --driver ego=socket:s.sock -o a.mcap & run=$!; until '" +
                  odd_driver + "' steady s.sock; do kill -0 $run || exit 9; done; wait $run",
              folder_);
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_FALSE(fs::exists(folder_ / "s.sock"));
    expect_equal("a.mcap", 100);
    drive("one", odd_driver + " steady", "b.mcap");
    EXPECT_TRUE(bytes("a.mcap") == bytes("b.mcap")) << "how it came is nothing that is recorded";
}

TEST_F(Drivers, OneThatRunsAlreadyComesToAPort) {
    const std::string in_python = PYTHON
        " -B -c \"import reprise; reprise.drive(lambda seen: reprise.Control(0.25, "
        "steer=0.125, lamps=8), '127.0.0.1:$port')\"";
    for (const std::string& driver : {odd_driver + " steady 127.0.0.1:$port", in_python}) {
        const Result result = typed(
            "export PYTHONPATH=" + source("python") +
                "; reprise run one.lua --driver ego=tcp:0 -o a.mcap 2>said & run=$!; until port=$("
                "sed -n 's/.*may come to 127.0.0.1://p' said 2>/dev/null | grep .); do kill -0 "
                "$run || exit 9; done; " +
                driver + "; wait $run",
            folder_);
        EXPECT_EQ(result.code, 0) << result.out << bytes("said");
        expect_equal("a.mcap", 100);
        drive("one", odd_driver + " steady", "b.mcap");
        EXPECT_TRUE(bytes("a.mcap") == bytes("b.mcap"))
            << "how it came is nothing that is recorded";
    }
}

TEST_F(Drivers, APortThatIsTakenIsSaidBeforeAnythingIsDone) {
    const Result result = typed(
        "reprise run one.lua --driver ego=tcp:0 -o a.mcap 2>said & run=$!; until port=$(sed "
        "-n 's/.*may come to 127.0.0.1://p' said 2>/dev/null | grep .); do kill -0 $run || "
        "exit 9; done; reprise run one.lua --driver ego=tcp:$port -o b.mcap; code=$?; kill "
        "$run; wait $run; exit $code",
        folder_);
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("cannot listen there: Address already in use"));
}

TEST_F(Drivers, AnswersActAsManyTicksLaterAsTheScenarioSays) {
    constexpr std::uint64_t first = 1;  // the tick in which it appears, and that it is shown
    for (const std::uint64_t latency : {0U, 1U, 5U}) {
        const std::string trace_name = fmt::format("late{}.mcap", latency);
        write_scenario("late", spawn("ego", 20, fmt::format(", latency = {}", latency)));
        drive("late", odd_driver + " counting", trace_name);
        expect_equal(trace_name, 100);
        replay::TraceReader trace(folder_ / trace_name);
        for (std::uint64_t index = first; index <= trace.ticks(); ++index) {
            const world::Control& control = trace.tick(index).view.controls()[0];
            if (index < first + 1 + latency) {
                EXPECT_EQ(control.brake(), 1) << "nobody has answered at tick " << index;
                continue;
            }
            const auto answered = static_cast<double>(index - 1 - latency);
            EXPECT_EQ(control.steer() * 1024, answered) << "of latency " << latency;
            EXPECT_EQ(control.brake(), 0);
        }
    }
    drive("one", odd_driver + " counting", "none.mcap");
    const auto places = [&](const std::string& trace) {
        return run({"cat", trace, "--fields", "vehicles", "--format", "csv"}, 0);
    };
    EXPECT_EQ(places("none.mcap"), places("late0.mcap"));
    EXPECT_NE(places("none.mcap"), places("late1.mcap"));
}

TEST_F(Drivers, WhoIsShownEachFewTicksHoldsWhatItSaidUntilItsNextAnswerActs) {
    constexpr std::uint64_t first = 1;  // the tick in which it appears, and that it is shown
    for (const auto& [latency, every] : {std::pair<std::uint64_t, std::uint64_t>(0, 2),
                                         std::pair<std::uint64_t, std::uint64_t>(0, 7),
                                         std::pair<std::uint64_t, std::uint64_t>(1, 2),
                                         std::pair<std::uint64_t, std::uint64_t>(5, 3)}) {
        write_scenario("few",
                       spawn("ego", 20, fmt::format(", latency = {}, every = {}", latency, every)));
        drive("few", odd_driver + " counting", "few.mcap");
        expect_equal("few.mcap", 100);
        replay::TraceReader trace(folder_ / "few.mcap");
        for (std::uint64_t index = first; index <= trace.ticks(); ++index) {
            const world::Control& control = trace.tick(index).view.controls()[0];
            if (index < first + 1 + latency) {
                EXPECT_EQ(control.brake(), 1) << "nobody has answered at tick " << index;
                continue;
            }
            const std::uint64_t last_heard = index - 1 - latency;
            const std::uint64_t shown = last_heard - (last_heard - first) % every;
            EXPECT_EQ(control.steer() * 1024, static_cast<double>(shown))
                << "tick " << index << ", latency " << latency << ", every " << every;
        }
    }
}

TEST_F(Drivers, KilledAtAnyTickLeaveAWholeTraceThatSaysSo) {
    const int times = std::getenv("REPRISE_THOROUGH") != nullptr ? 100 : 10;
    for (int i = 0; i < times; ++i) {
        const std::uint64_t tick =
            1 +
            world::draw_index(99, 14, static_cast<std::uint64_t>(i), world::Purpose::scenario, 0);
        SCOPED_TRACE(fmt::format("killed in tick {}", tick));
        const std::string said =
            drive("one", fmt::format("{} killed {}", odd_driver, tick), "a.mcap", 1);
        EXPECT_THAT(said, HasSubstr("the driver of 'ego' was ended by signal 9"));
        EXPECT_THAT(said, HasSubstr("driver_lost: the driver of 'ego' was lost"));
        EXPECT_FALSE(fs::exists(folder_ / "a.mcap.partial"));
        expect_equal("a.mcap", tick);
        EXPECT_THAT(run({"info", "a.mcap"}, 0), HasSubstr("driver_lost"));
    }
}

TEST_F(Drivers, LostOnesCanBeDoneEverythingWith) {
    drive("one", odd_driver + " killed 60", "a.mcap", 1);
    run({"strip", "a.mcap", "-o", "s.mcap", "--level", "inputs"}, 0);
    expect_equal("s.mcap", 60);
    run({"expand", "s.mcap", "-o", "e.mcap"}, 0);
    EXPECT_TRUE(bytes("e.mcap") == bytes("a.mcap"));
    run({"slice", "a.mcap", "--ticks", "1..60", "-o", "all.mcap"}, 0);
    expect_equal("all.mcap", 60);
    run({"slice", "a.mcap", "--ticks", "1..40", "-o", "part.mcap"}, 0);
    expect_equal("part.mcap", 40);
    EXPECT_THAT(run({"run", "a.mcap", "-o", "again.mcap"}, 1), HasSubstr("driver_lost"));
    EXPECT_TRUE(bytes("again.mcap") == bytes("a.mcap")) << "made again, it ends where it did";
    run({"run", "a.mcap", "-o", "short.mcap", "--for", "1"}, 0);
    expect_equal("short.mcap", 20);
}

TEST_F(Drivers, WhoWantsTheRunToEndIsNotLost) {
    write_scenario("one",
                   spawn("ego", 20) +
                       "check.never('no', function() return false end)\n"
                       "check.min('fast', function() return 0 end, 1)\n");
    const std::string failed = drive("one", odd_driver + " leaves", "f.mcap", 1);
    EXPECT_THAT(failed, HasSubstr("ended: by the driver of 'ego'"))
        << "a check that had failed is told all the same";
    write_scenario("one", spawn("ego", 20));
    const std::string said = drive("one", odd_driver + " leaves", "a.mcap");
    EXPECT_THAT(said, HasSubstr("ended: by the driver of 'ego'"));
    EXPECT_THAT(said, Not(HasSubstr("lost")));
    for (const std::string trace : {"f.mcap", "a.mcap"})
        expect_equal(trace, 3);
    run({"run", "a.mcap", "-o", "again.mcap"}, 0);
    EXPECT_TRUE(bytes("again.mcap") == bytes("a.mcap")) << "made again, it ends where it did";
    run({"strip", "a.mcap", "-o", "s.mcap", "--level", "inputs"}, 0);
    run({"expand", "s.mcap", "-o", "e.mcap"}, 0);
    EXPECT_TRUE(bytes("e.mcap") == bytes("a.mcap"));
    forge("a.mcap", 3, world::outcome_of_left_driver("other", 3));
    EXPECT_THAT(run({"verify", "forged.mcap"}, 1), HasSubstr("by the driver of 'other'"));
}

TEST_F(Drivers, LossThatIsForgedIsTold) {
    drive("one", odd_driver + " steady", "whole.mcap");
    drive("one", odd_driver + " killed 60", "lost.mcap", 1);
    write_scenario("alone", "spawn{ name = 'ego', model = 'sedan', lane = 'am_1', s = 20 }\n");
    run({"run", "alone.lua", "-o", "alone.mcap"}, 0);
    const auto expect_told = [&](const std::string& from,
                                 std::uint64_t ticks,
                                 const world::Outcome& outcome,
                                 const std::string& what) {
        SCOPED_TRACE(what);
        forge(from, ticks, outcome);
        EXPECT_THAT(run({"verify", "forged.mcap"}, 1), HasSubstr("driver_lost"));
        EXPECT_THAT(run({"info", "forged.mcap"}, 2), HasSubstr("it was changed after"));
    };
    forge("lost.mcap", 60, world::outcome_of_lost_driver("ego", 60));
    EXPECT_TRUE(bytes("forged.mcap") == bytes("lost.mcap")) << "nothing else is changed by forge";
    expect_told("alone.mcap", 60, world::outcome_of_lost_driver("ego", 60), "nobody else drives");
    expect_told("whole.mcap", 100, world::outcome_of_lost_driver("ego", 100), "it had ended");
    expect_told("lost.mcap", 60, world::outcome_of_lost_driver("other", 60), "another's name");
}

TEST_F(Drivers, CtrlCWhileOneIsWaitedForEndsTheRunAndTheDriver) {
    const std::string said =
        drive("one", "exec " + odd_driver + " interrupts", "a.mcap", 128 + SIGINT);
    const std::regex told(R"(reprise: stopped \(Interrupt\) behind tick 3; [^:]*: (.*))");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(said, found, told)) << said;
    const pid_t driver = std::stoi(bytes("odd_driver.pid"));
    EXPECT_EQ(kill(driver, 0), -1) << "the driver is left behind";
    EXPECT_FALSE(fs::exists(folder_ / "a.mcap"));
    EXPECT_EQ(typed(found[1], folder_).code, 3);
    expect_equal("a.mcap", 3);
}

TEST_F(Drivers, SilentOnesAreLostAfterTheirTime) {
    // Long enough for a driver's start, and for its answers to two ticks, on a machine that is
    // loaded.
    const std::string said = run({"run",
                                  "one.lua",
                                  "--driver",
                                  "ego=" + odd_driver + " silent",
                                  "--driver-timeout",
                                  "2",
                                  "-o",
                                  "a.mcap"},
                                 1);
    EXPECT_THAT(said, HasSubstr("the driver of 'ego' said nothing in time"));
    expect_equal("a.mcap", 3);
}

TEST_F(Drivers, OfAProgramThatHasEndedNobodyWaitsForTheSocketOfItsChild) {
    const std::string said = drive("one", odd_driver + " leaves_a_child", "a.mcap", 1);
    EXPECT_THAT(said, HasSubstr("the driver of 'ego' ended with exit code 3"));
    expect_equal("a.mcap", 3);
}

TEST_F(Drivers, WhoAppearsInTheLastTickDidAppear) {
    write_file(folder_ / "short.lua",
               "return scenario 'short' { town = 'small.net.xml', cars = 0, run = function()\n" +
                   spawn("ego", 20) + "finish 'at once' end }\n");
    const std::string said = drive("short", python_driver, "a.mcap");
    EXPECT_THAT(said, Not(HasSubstr("nobody was spawned")));
    EXPECT_THAT(said, Not(HasSubstr("Traceback"))) << "there was nothing to drive: no mistake";
    expect_equal("a.mcap", 1);
}

TEST_F(Drivers, ALateOnesAnswerToARunThatIsOverIsNoMistakeOfIts) {
    write_scenario("late", spawn("ego", 20, ", latency = 60"));
    write_file(folder_ / "slow.py",
               "import os, reprise, select\n"
               "def decide(seen):\n"
               "    while seen.index == 50 and os.path.exists('a.mcap.partial'):\n"
               "        select.select([], [], [], 0.001)\n"
               "    return reprise.Control(0.3)\n"
               "reprise.drive(decide)\n");
    const std::string said = drive("late", PYTHON " -B slow.py", "a.mcap");
    EXPECT_THAT(said, Not(HasSubstr("Traceback")));
    expect_equal("a.mcap", 100);
}

TEST_F(Drivers, ATimeoutIsANumberAboveZero) {
    for (const std::string wrong : {"0", "-1", "nan", "inf", "soon"}) {
        const std::string said = run({"run",
                                      "one.lua",
                                      "--driver",
                                      "ego=" + python_driver,
                                      "--driver-timeout",
                                      wrong,
                                      "-o",
                                      "a.mcap"},
                                     2);
        EXPECT_LT(said.size(), 200U) << said;
    }
    EXPECT_FALSE(fs::exists(folder_ / "a.mcap"));
}

TEST_F(Drivers, SomebodyMustDrive) {
    EXPECT_THAT(run({"run", "one.lua", "-o", "a.mcap"}, 2),
                HasSubstr("one.lua:3: spawn: 'ego' is driven by another program: say which by "
                          "--driver ego='COMMAND'"));
    EXPECT_FALSE(fs::exists(folder_ / "a.mcap"));
    EXPECT_FALSE(fs::exists(folder_ / "a.mcap.partial"));
    EXPECT_THAT(
        run({"run", "one.lua", "--driver", "egg=" + odd_driver + " steady", "-o", "a.mcap"}, 2),
        HasSubstr("say which by --driver ego='COMMAND'; there is a driver for egg\n"));
    write_file(folder_ / "late.lua",
               "return scenario 'late' { run = function() wait(1)\n"
               "spawn{ name = 'ego', model = 'sedan', driver = 'external' } wait(1) end }");
    EXPECT_THAT(run({"run", "late.lua", "-o", "a.mcap"}, 2),
                HasSubstr("'COMMAND'; what was recorded until then is in a.mcap.partial: reprise "
                          "recover a.mcap.partial -o a.mcap"));
    EXPECT_TRUE(fs::exists(folder_ / "a.mcap.partial"));
    EXPECT_THAT(drive("one", python_driver + "; exit 7", "b.mcap"), Not(HasSubstr("exit code")))
        << "how it ends behind the end is its own affair";
}

}  // namespace
}  // namespace reprise::test
