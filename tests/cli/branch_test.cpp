#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

/// A drive of 6 s among SUMO's cars, and scripts that might have gone on with it.
class Branch : public testing::Test {
  protected:
    void SetUp() override {
        write_file(folder_ / "drive.lua", R"(
            return scenario 'drive' { town = 'town1', cars = 10, seed = 3, run = function()
                local ego = spawn{ name = 'ego', model = 'sedan' }
                local hand = spawn{ name = 'hand', model = 'sedan', driver = 'manual' }
                check.eventually('late', function() return tick() >= 90 end)
                hand:control{ throttle = 0.2, brake = 0, steer = 0.05 }
                random() random()
                wait(6)
            end })");
        write_script("nothing", "wait(60)");
        write_script("brake", "actor('ego'):set_speed(0) wait(60)");
        run({"run", "drive.lua", "-o", "parent.mcap"}, 0);
    }

    void write_script(const std::string& name, const std::string& body) {
        write_file(folder_ / (name + ".lua"),
                   "return scenario '" + name + "' { params = { gap = 1 }, run = function(p)\n" +
                       body + "\nend }\n");
    }

    std::string run(const std::vector<std::string>& words, int code) {
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, code) << result.out;
        return result.out;
    }

    std::string branch(const std::string& script, const std::string& out, int code = 0) {
        return run({"branch", "parent.mcap", "--at", "2.5s", "--script", script, "-o", out}, code);
    }

    const Folder folder_;
};

TEST_F(Branch, IsTheParentUpToTheTickAndThenTheEffect) {
    branch("brake.lua", "brake.mcap");
    const std::string diff = run({"diff", "parent.mcap", "brake.mcap"}, 1);
    EXPECT_THAT(diff,
                HasSubstr("equal for 50 ticks; branched at tick 50 (2.50 s) by brake.lua; first "
                          "difference:\ntick 51 (2.55 s), stage scenario, ego (1)\n"
                          "  field     commands[0]\n  expected  absent\n  found     set_speed\n"));
    EXPECT_THAT(run({"info", "brake.mcap"}, 0),
                HasSubstr("at tick 50 (2.50 s) brake (brake.lua) took over from chain "));
    EXPECT_THAT(run({"verify", "brake.mcap"}, 0), HasSubstr("equal at every one of 1200 ticks"));
}

TEST_F(Branch, ThatDoesNothingLeavesTheWorldOnItsWay) {
    branch("nothing.lua", "nothing.mcap");
    const std::string diff = run({"diff", "parent.mcap", "nothing.mcap"}, 1);
    EXPECT_THAT(diff, HasSubstr("stage scenario\n  field     digests.scenario"));
    // Until the parent's own script ends the run, only what the scripts keep differs.
    EXPECT_THAT(run({"info", "parent.mcap"}, 0), HasSubstr("122 ticks"));
    EXPECT_THAT(diff, HasSubstr("in the record it first shows at tick 122, stage scenario: "));
}

/// Among people on foot as well, whose steps a second thread makes: it is not there to be copied.
TEST_F(Branch, SeveralFromOneTickAreWhatEachIsAlone) {
    run({"run", "drive.lua", "--walkers", "20", "-o", "parent.mcap"}, 0);
    write_script("swerve", "actor('hand'):control{ throttle = 1, steer = -0.3 } wait(60)");
    run({"branch",
         "parent.mcap",
         "--at",
         "50t",
         "--script",
         "brake.lua",
         "nothing.lua",
         "swerve.lua",
         "-o",
         "together",
         "--for",
         "2"},
        0);
    for (const std::string script : {"brake", "nothing", "swerve"}) {
        run({"branch",
             "parent.mcap",
             "--at",
             "50t",
             "--script",
             script + ".lua",
             "-o",
             "alone.mcap",
             "--for",
             "2"},
            0);
        EXPECT_TRUE(read_file(folder_ / "alone.mcap") ==
                    read_file(folder_ / ("together/" + script + ".mcap")))
            << script;
        EXPECT_THAT(run({"verify", "alone.mcap"}, 0), HasSubstr("equal at every one of 90 ticks"));
    }
    EXPECT_THAT(run({"diff", "together/brake.mcap", "together/swerve.mcap"}, 1),
                HasSubstr("the expected run branched at tick 50 (2.50 s) by brake.lua; the found "
                          "run branched at tick 50 (2.50 s) by swerve.lua"));
}

TEST_F(Branch, CanBeStrippedExpandedMadeAgainAndBranched) {
    run({"branch",
         "parent.mcap",
         "--at",
         "50t",
         "--script",
         "brake.lua",
         "-o",
         "b.mcap",
         "--for",
         "3"},
        0);
    const std::string bytes = read_file(folder_ / "b.mcap");
    run({"strip", "b.mcap", "-o", "s.mcap", "--level", "inputs"}, 0);
    run({"expand", "s.mcap", "-o", "e.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "e.mcap") == bytes);
    run({"run", "b.mcap", "-o", "again.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "again.mcap") == bytes);
    run({"branch", "b.mcap", "--at", "80t", "--script", "nothing.lua", "-o", "bb.mcap"}, 0);
    EXPECT_THAT(run({"verify", "bb.mcap"}, 0), HasSubstr("equal at every one of 110 ticks"));
    EXPECT_THAT(run({"diff", "b.mcap", "bb.mcap"}, 1),
                HasSubstr("equal for 80 ticks; branched at tick 80 (4.00 s) by nothing.lua"));
    EXPECT_THAT(
        run({"branch", "b.mcap", "--at", "50t", "--script", "brake.lua", "-o", "x.mcap"}, 2),
        HasSubstr("expected a tick from 51 to 109"));
}

/// The random streams go on, names stay taken, who was decided on stays decided.
TEST_F(Branch, FindsTheWorldAsItIs) {
    write_script("look",
                 "local ego, hand = actor('ego'), actor 'hand'\n"
                 "print(ego:name(), ego:distance_driven() > 1, hand:exists(), tick(), p.gap)\n"
                 "print(random())\n"
                 "check.always('there', function() return ego:exists() end)\n"
                 "local other = spawn{ model = 'sedan', name = 'other' }\n"
                 "wait(1) print(other:id(), other:exists())");
    write_file(folder_ / "three.lua", R"(
            return scenario 'three' { town = 'town1', seed = 3, run = function()
                random() random() print(random())
            end })");
    const std::string drawn = run({"run", "three.lua", "-o", "three.mcap"}, 0);
    const std::size_t from = drawn.find(" s  0.") + 4;
    const std::string third = drawn.substr(from, drawn.find('\n', from) - from);
    ASSERT_GT(third.size(), 10U) << drawn;
    const std::string out = run({"branch",
                                 "parent.mcap",
                                 "--at",
                                 "100t",
                                 "--script",
                                 "look.lua",
                                 "-o",
                                 "look.mcap",
                                 "--set",
                                 "gap=7"},
                                0);
    EXPECT_THAT(out, HasSubstr("passed: scenario ended"));
    const std::string again = run({"run", "look.mcap", "-o", "again.mcap"}, 0);
    EXPECT_THAT(again, HasSubstr("ego true true 100 7"));
    EXPECT_THAT(again, HasSubstr(" s  " + third + "\n"));
    EXPECT_THAT(again, HasSubstr("3 true"));
    EXPECT_THAT(again, HasSubstr("pass          late"));
    EXPECT_THAT(again, HasSubstr("pass          there"));
}

TEST_F(Branch, SaysWhatIsWrongAndLeavesNothing) {
    write_script("typo", "actor('egg')");
    write_file(folder_ / "rain.lua",
               "return scenario 'rain' { weather = 'clear_noon', run = function() end }");
    const std::vector<std::string> before = folder_.files();
    EXPECT_THAT(branch("typo.lua", "x.mcap", 2),
                HasSubstr("typo.lua:2: actor: nobody is called 'egg' (did you mean 'ego'?)"));
    EXPECT_THAT(branch("rain.lua", "x.mcap", 2), HasSubstr("set_weather changes the weather"));
    EXPECT_THAT(branch("brake.lua", "parent.mcap", 2), HasSubstr("the output is the input"));
    EXPECT_THAT(branch("non.lua", "x.mcap", 2), HasSubstr("no scenario file 'non.lua'"));
    EXPECT_THAT(
        run({"branch", "parent.mcap", "--at", "9s", "--script", "brake.lua", "-o", "x.mcap"}, 2),
        HasSubstr("--at 9s: expected a tick from 1 to "));
    write_script("over", "");
    run({"branch", "parent.mcap", "--at", "119t", "--script", "over.lua", "-o", "short.mcap"}, 0);
    EXPECT_THAT(
        run({"branch", "short.mcap", "--at", "50t", "--script", "over.lua", "-o", "x.mcap"}, 2),
        HasSubstr(
            "short.mcap: too short to branch: it holds 120 ticks and branched off itself at 119"));
    std::filesystem::remove(folder_ / "short.mcap");
    std::filesystem::remove(folder_ / "over.lua");
    run({"run", "drive.lua", "-o", "nudged.mcap", "--nudge", "30:ego.velocity.x"}, 0);
    EXPECT_THAT(
        run({"branch", "nudged.mcap", "--at", "50t", "--script", "brake.lua", "-o", "x.mcap"}, 1),
        HasSubstr("tick 30 (1.50 s), stage physics"));
    std::filesystem::remove(folder_ / "nudged.mcap");
    EXPECT_EQ(folder_.files(), before);
}

/// A wait for `p.wait` seconds that looks at its parameter in every tick.
class BranchOfParameters : public Branch {
  protected:
    void SetUp() override {
        write_file(folder_ / "patient.lua", R"(
            return scenario 'patient' { town = 'town1', cars = 10, seed = 3,
                params = { wait = 3, word = 'ready' },
                run = function(p)
                    local ego = spawn{ name = 'ego', model = 'sedan' }
                    p.word = p.word .. '!'
                    wait_until(function() return tick() >= p.wait * 20 end)
                    print(p.word)
                    ego:set_speed(0)
                    wait(1)
                end })");
        run({"run", "patient.lua", "-o", "parent.mcap"}, 0);
    }
};

TEST_F(BranchOfParameters, GoesOnWithTheRunsOwnScriptWhereItIs) {
    run({"branch", "parent.mcap", "--at", "2.5s", "--set", "wait=4", "-o", "late.mcap"}, 0);
    EXPECT_THAT(
        run({"diff", "parent.mcap", "late.mcap"}, 1),
        HasSubstr(
            "equal for 50 ticks; branched at tick 50 (2.50 s) by wait = 4; first difference"));
    EXPECT_THAT(run({"verify", "late.mcap"}, 0), HasSubstr("equal at every one of 101 ticks"));
    const std::string info = run({"info", "late.mcap"}, 0);
    EXPECT_THAT(info, HasSubstr("at tick 50 (2.50 s) patient (patient.lua) went on from chain "));
    EXPECT_THAT(info, HasSubstr("            wait = 4\n"));
    EXPECT_THAT(info, HasSubstr("4.05 s  ready!\n"));

    // What a run that had it from the start does, when nothing looked at it before.
    run({"run", "patient.lua", "--set", "wait=4", "-o", "four.mcap"}, 0);
    const auto places = [&](const std::string& trace) {
        return run({"cat", trace, "--fields", "vehicles.position", "--format", "csv"}, 0);
    };
    EXPECT_EQ(places("late.mcap"), places("four.mcap"));
    EXPECT_NE(places("late.mcap"), places("parent.mcap"));
}

TEST_F(BranchOfParameters, IsRememberedByEveryWayToMakeItAgain) {
    run({"branch", "parent.mcap", "--at", "50t", "--set", "wait=4", "-o", "late.mcap"}, 0);
    const std::string bytes = read_file(folder_ / "late.mcap");
    run({"run", "late.mcap", "-o", "again.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "again.mcap") == bytes);
    run({"strip", "late.mcap", "-o", "s.mcap", "--level", "inputs"}, 0);
    run({"expand", "s.mcap", "-o", "e.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "e.mcap") == bytes);
    // And may change once more; what the script itself wrote stays unless it is named.
    run({"branch", "late.mcap", "--at", "60t", "--set", "wait=3.5", "--set", "word=go", "-o", "b"},
        0);
    EXPECT_THAT(run({"verify", "b/late.mcap"}, 0), HasSubstr("equal at every one of 91 ticks"));
    EXPECT_THAT(run({"info", "b/late.mcap"}, 0), HasSubstr("3.55 s  go\n"));
}

TEST_F(BranchOfParameters, SaysWhatIsWrong) {
    EXPECT_THAT(run({"branch", "parent.mcap", "--at", "50t", "-o", "x.mcap"}, 2),
                HasSubstr("nothing would be different: give --script"));
    EXPECT_THAT(run({"branch", "parent.mcap", "--at", "50t", "--set", "wiat=1", "-o", "x.mcap"}, 2),
                HasSubstr("--set wiat=1: no parameter 'wiat' (did you mean 'wait'?)"));
    EXPECT_THAT(
        run({"branch", "parent.mcap", "--at", "1.5t", "--set", "wait=1", "-o", "x.mcap"}, 2),
        HasSubstr("expected a tick such as 120t or a time such as 2.5s, got '1.5t'"));
    // Ticks or seconds? 50 and 50.0 look alike.
    for (const char* bare : {"50", "2.5"})
        EXPECT_THAT(
            run({"branch", "parent.mcap", "--at", bare, "--set", "wait=1", "-o", "x.mcap"}, 2),
            HasSubstr(std::string("--at ") + bare + ": ticks or seconds? Write " + bare + "s"));
}

TEST_F(Branch, HasAWordThatOtherScenariosDoNot) {
    write_file(folder_ / "early.lua",
               "return scenario 'early' { run = function() actor('ego') end }");
    EXPECT_THAT(run({"run", "early.lua", "-o", "x.mcap"}, 2), HasSubstr("actor"));
}

}  // namespace
}  // namespace reprise::test
