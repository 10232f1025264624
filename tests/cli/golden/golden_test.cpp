// reprise test, accept and golden list, as a user calls them.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <pugixml.hpp>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* small_scenario = R"(return scenario 'small' {
    town = 'town1', duration = 2, seed = 7, cars = 5,
    params = { speed_kmh = 26, limit = 60, word = 'hello' },
    run = function(p)
        local lane = pick_lane{ length = 90, straight = true }
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot',
                           lane = lane, s = 6, speed_kmh = p.speed_kmh }
        check.max('speed', function() return ego:speed_kmh() end, p.limit)
        wait(1)
        print(p.word)
    end,
}
)";

/// A folder with one small scenario, s/small.lua, and its golden.
class Goldens : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directory(folder_ / "s");
        write_file(folder_ / "s/small.lua", small_scenario);
        const Result first = call({"accept", "s/small.lua", "--because", "first golden"});
        ASSERT_EQ(first.code, 0) << first.out;
    }

    Result call(const std::vector<std::string>& words) { return reprise(words, folder_.path()); }

    /// Changes the first such text of a file.
    void edit(const std::string& name, const std::string& before, const std::string& after) {
        std::string text = read_file(folder_ / name);
        const auto at = text.find(before);
        ASSERT_NE(at, std::string::npos) << before;
        write_file(folder_ / name, text.replace(at, before.size(), after));
    }

    /// Copies the thin program beside a script of ours that stands for reprise-run; in it $REAL is
    /// the true one.
    std::string with_runner(const std::string& script) {
        fs::create_directory(folder_ / "bin");
        const fs::path real = fs::path(REPRISE_PROGRAM).parent_path() / "reprise-run";
        fs::copy_file(REPRISE_PROGRAM, folder_ / "bin/reprise");
        write_file(folder_ / "bin/reprise-run",
                   "#!/bin/sh\nREAL='" + real.string() + "'\n" + script);
        fs::permissions(folder_ / "bin/reprise-run", fs::perms::owner_all);
        return folder_ / "bin/reprise";
    }

    Folder folder_;
};

/// What scenarios/ promises. Goldens that change are accepted one by one, with a reason.
TEST(ShippedScenarios, AreEqualToTheirGoldens) {
    const Folder output;
    const Result result =
        reprise({"test", source("scenarios"), "--output", output / "failed", "--jobs", "2"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, Not(HasSubstr("0 passed")));
}

TEST_F(Goldens, ScenarioWhoseLinesMoveStillPasses) {
    edit("s/small.lua", "return scenario", "-- A comment,\n-- and another.\nreturn scenario");
    const Result test = call({"test"});
    EXPECT_EQ(test.code, 0) << test.out;
    EXPECT_THAT(test.out, HasSubstr("the scenario's text changed without effect"));
}

TEST_F(Goldens, EqualRunPassesAndLeavesNothing) {
    const auto before = folder_.files();
    const Result result = call({"test", "s"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("passed    s/small  equal, verdict passed"));
    EXPECT_THAT(result.out, HasSubstr("1 passed, 0 changed, 0 nondeterministic"));
    EXPECT_EQ(folder_.files(), before);
}

TEST_F(Goldens, ScenarioThatFailsItsCheckPassesWhenThatIsItsGolden) {
    edit("s/small.lua", "limit = 60", "limit = 10");
    fs::remove(folder_ / "s/small.golden");
    ASSERT_EQ(call({"accept", "s/small.lua", "--because", "must be too fast"}).code, 0);
    const Result result = call({"test", "s"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("equal, verdict failed"));
}

struct Change {
    const char* name;
    const char* before;
    const char* after;
    std::vector<std::string> said;
};

void PrintTo(const Change& change, std::ostream* out) {
    *out << change.name;
}

class Changes : public Goldens, public testing::WithParamInterface<Change> {};

TEST_P(Changes, AreToldBySeverityAndAcceptedWithAReason) {
    const Change& change = GetParam();
    edit("s/small.lua", change.before, change.after);
    const Result test = call({"test"});
    EXPECT_EQ(test.code, 1);
    for (const std::string& text : change.said)
        EXPECT_THAT(test.out, HasSubstr(text));
    EXPECT_THAT(test.out, HasSubstr("repeatable, 2 of 2 runs equal"));
    EXPECT_THAT(test.out, HasSubstr("reprise accept s/small.lua --because"));
    EXPECT_LT(std::count(test.out.begin(), test.out.end(), '\n'), 24) << test.out;
    EXPECT_TRUE(fs::exists(folder_ / "reprise-test/s/small.mcap"));

    const Result accept = call({"accept", "s/small.lua", "--because", "it is better so"});
    EXPECT_EQ(accept.code, 0) << accept.out;
    EXPECT_THAT(read_file(folder_ / "s/small.golden"),
                HasSubstr("\"because\": \"it is better so\",\n"));
    EXPECT_EQ(call({"test"}).code, 0);
    EXPECT_FALSE(fs::exists(folder_ / "reprise-test")) << "what failed before lies there still";
}

INSTANTIATE_TEST_SUITE_P(
    Goldens,
    Changes,
    testing::Values(
        Change{"Verdict",
               "limit = 60",
               "limit = 10",
               {"verdicts changed",
                "check 'speed': golden passed",
                "now failed at",
                "set limit: golden 60, now 10"}},
        Change{"Event",
               "'hello'",
               "'good day'",
               {"events changed", "printed 'hello'", "printed 'good day'", "small.lua:10"}},
        Change{"Numbers",
               "speed_kmh = 26",
               "speed_kmh = 27",
               {"only numbers changed", "first differ between 0.00 s and 1.00 s", "ego#1 x"}}),
    [](const testing::TestParamInfo<Change>& tested) { return tested.param.name; });

TEST_F(Goldens, KeptTraceTellsTheExactTick) {
    ASSERT_EQ(call({"test", "--keep", "kept"}).code, 0);
    edit("s/small.lua", "'hello'", "'hallo'");
    const Result result = call({"test", "--keep", "kept"});
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.out, HasSubstr("exactly   tick 21 (1.05 s), stage scenario"));
    EXPECT_THAT(result.out, HasSubstr("reprise diff kept/"));
}

/// Another version of the program: a copy of ours in which one line of the fingerprint is another.
TEST_F(Goldens, AnotherBuildIsNamedLineByLine) {
    edit("s/small.lua", "speed_kmh = 26", "speed_kmh = 27");
    const std::string program = with_runner("exec ./other-run \"$@\"\n");
    std::string bytes = read_file(fs::path(REPRISE_PROGRAM).parent_path() / "reprise-run");
    const std::string flags = "-ffp-contract=off -march";
    const auto at = bytes.find(flags);
    ASSERT_NE(at, std::string::npos);
    write_file(folder_ / "other-run", bytes.replace(at, flags.size(), "-ffp-contract=owl -march"));
    fs::permissions(folder_ / "other-run", fs::perms::owner_all);
    fs::copy(source("scenarios/towns"), folder_ / "s/towns", fs::copy_options::recursive);
    const Result result = run_program(program, {"test"}, folder_.path());
    EXPECT_EQ(result.code, 1) << result.out;
    EXPECT_THAT(result.out, HasSubstr("another build made the golden"));
    EXPECT_THAT(result.out, HasSubstr("flags: golden -O2 -ffp-contract=off"));
    EXPECT_THAT(result.out, HasSubstr("now -O2 -ffp-contract=owl"));
}

TEST_F(Goldens, NondeterministicCandidateIsToldFromAChangedOne) {
    const std::string program = with_runner("exec \"$REAL\" \"$@\" --seed $$\n");
    const Result test = run_program(program, {"test"}, folder_.path());
    EXPECT_EQ(test.code, 3);
    EXPECT_THAT(test.out, HasSubstr("NONDETERMINISTIC s/small"));
    EXPECT_THAT(test.out, HasSubstr("tick 1 (0.05 s), stage"));
    EXPECT_THAT(test.out, HasSubstr("0 passed, 0 changed, 1 nondeterministic"));
    EXPECT_TRUE(fs::exists(folder_ / "reprise-test/s/small.mcap"));
    EXPECT_TRUE(fs::exists(folder_ / "reprise-test/s/small.second.mcap"));

    const std::string before = read_file(folder_ / "s/small.golden");
    const Result accept =
        run_program(program, {"accept", "s/small.lua", "--because", "why not"}, folder_.path());
    EXPECT_EQ(accept.code, 3);
    EXPECT_THAT(accept.out, HasSubstr("REFUSED   s/small  nondeterministic"));
    EXPECT_EQ(read_file(folder_ / "s/small.golden"), before);
}

TEST_F(Goldens, CrashIsNoVerdict) {
    const std::string program = with_runner("echo about to fall\nkill -SEGV $$\n");
    const Result result = run_program(program, {"test"}, folder_.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("ERROR     s/small  the run was ended by signal 11"));
    EXPECT_THAT(result.out, HasSubstr("about to fall"));
    EXPECT_THAT(result.out, HasSubstr("1 with errors"));
}

TEST_F(Goldens, InterruptedTestLeavesNoRunAndNoFolder) {
    fs::create_directory(folder_ / "tmp");
    setenv("TMPDIR", (folder_ / "tmp").c_str(), 1);
    // The run interrupts its parent as Ctrl-C would, then hangs; its own child as well.
    const std::string program = with_runner("echo $$ > pid\nkill -INT $PPID\nsleep 1000 &\nwait\n");
    const Result result = run_program(program, {"test"}, folder_.path());
    unsetenv("TMPDIR");
    EXPECT_EQ(result.code, 128 + SIGINT);
    EXPECT_THAT(result.out, HasSubstr("interrupted"));
    EXPECT_TRUE(fs::is_empty(folder_ / "tmp"));
    const pid_t group = std::stoi(read_file(folder_ / "pid"));
    EXPECT_EQ(kill(group, 0), -1) << "the run is still there";
}

TEST_F(Goldens, ScenarioErrorIsNotAChange) {
    edit("s/small.lua", "wait(1)", "wiat(1)");
    const Result result = call({"test", "--junit", "results.xml"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("ERROR     s/small  small.lua:9:"));
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder_ / "results.xml").c_str()));
    EXPECT_STREQ(document.select_node("//error/@type").attribute().value(), "script");
}

TEST_F(Goldens, MissingGoldenFailsAndSaysHowToMakeOne) {
    fs::remove(folder_ / "s/small.golden");
    const Result result = call({"test"});
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.out, HasSubstr("NO GOLDEN s/small"));
    EXPECT_THAT(result.out, HasSubstr("reprise accept s/small.lua --because \"...\""));
}

TEST_F(Goldens, OrphansFailTheTestAndAreListed) {
    EXPECT_EQ(call({"golden", "list", "--orphans"}).code, 0);
    fs::copy(folder_ / "s/small.golden", folder_ / "s/gone@late.golden");
    const Result test = call({"test"});
    EXPECT_EQ(test.code, 1);
    EXPECT_THAT(test.out, HasSubstr("ORPHAN    s/gone@late  there is no s/gone.lua"));
    EXPECT_THAT(test.out, HasSubstr("1 passed"));
    const Result list = call({"golden", "list", "--orphans"});
    EXPECT_EQ(list.code, 1);
    EXPECT_EQ(list.out, "s/gone@late.golden: there is no s/gone.lua\n");
}

TEST_F(Goldens, CasesRunAsTheirGoldenSays) {
    const Result accept = call({"accept",
                                "s/small.lua",
                                "--case",
                                "fast",
                                "--set",
                                "speed_kmh=50",
                                "--set",
                                "word=it's",
                                "--seed",
                                "3",
                                "--for",
                                "1.5",
                                "--because",
                                "a fast one"});
    ASSERT_EQ(accept.code, 0) << accept.out;
    const Result test = call({"test", "s/small.lua"});
    EXPECT_EQ(test.code, 0) << test.out;
    EXPECT_THAT(test.out, HasSubstr("s/small@fast  equal"));
    EXPECT_THAT(test.out, HasSubstr("2 passed"));
    const Result list = call({"golden", "list"});
    EXPECT_EQ(list.code, 0);
    EXPECT_THAT(list.out,
                HasSubstr("reprise run s/small.lua --seed 3 --for 1.5 --set speed_kmh=50 --set "
                          "'word=it'\\''s', passed; because \"a fast one\""));
    EXPECT_THAT(call({"test", "--list", "s/small@fast.golden"}).out, "s/small@fast\n");
}

TEST_F(Goldens, CaseOnANetworkOfOnesOwnRunsFromAnyFolder) {
    fs::create_directory(folder_ / "nets");
    fs::copy(source("scenarios/towns/town1/town1.net.xml"), folder_ / "nets/mine.net.xml");
    const Result accept = call({"accept",
                                "s/small.lua",
                                "--case",
                                "mine",
                                "--town",
                                "nets/mine.net.xml",
                                "--set",
                                "limit=80",
                                "--because",
                                "our own net"});
    ASSERT_EQ(accept.code, 0) << accept.out;
    EXPECT_THAT(read_file(folder_ / "s/small@mine.golden"), HasSubstr("\"town\": \"../nets/mine"));
    fs::create_directory(folder_ / "elsewhere");
    const Result test = reprise({"test", "../s/small@mine"}, folder_ / "elsewhere");
    EXPECT_EQ(test.code, 0) << test.out;
}

TEST_F(Goldens, JunitHasOneCaseForEachWithItsCommand) {
    fs::create_directory(folder_ / "t");
    write_file(folder_ / "t/small.lua", small_scenario);  // the same stem in another folder
    ASSERT_EQ(call({"accept", "t/small.lua", "--because", "also"}).code, 0);
    for (const char* name : {"s/small.lua", "t/small.lua"})
        edit(name, "'hello'", "'\\1<&\"\\255'");
    fs::copy(folder_ / "s/small.golden", folder_ / "t/gone.golden");
    const Result result = call({"test", ".", "--junit", "out/results.xml"});
    EXPECT_EQ(result.code, 2) << "the folder of the XML is not there";
    EXPECT_EQ(call({"test", ".", "--junit", "results.xml"}).code, 1);
    EXPECT_TRUE(fs::exists(folder_ / "reprise-test/s/small.mcap"));
    EXPECT_TRUE(fs::exists(folder_ / "reprise-test/t/small.mcap"));

    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder_ / "results.xml").c_str()));
    const std::string bytes = read_file(folder_ / "results.xml");
    EXPECT_TRUE(std::none_of(bytes.begin(), bytes.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    }));
    const pugi::xml_node suite = document.child("testsuites").child("testsuite");
    EXPECT_EQ(suite.attribute("tests").as_int(), 3);
    EXPECT_EQ(suite.attribute("failures").as_int(), 3);
    std::vector<std::string> names;
    for (const pugi::xml_node node : suite.children("testcase"))
        names.push_back(fmt::format("{}/{} {}",
                                    node.attribute("classname").value(),
                                    node.attribute("name").value(),
                                    node.child("failure").attribute("type").value()));
    EXPECT_THAT(names, ElementsAre("s/small changed", "t/gone orphan", "t/small changed"));
    EXPECT_STREQ(document.select_node("//property[@name='command']/@value").attribute().value(),
                 "reprise run s/small.lua");
    EXPECT_STREQ(document.select_node("//property[@name='seed']/@value").attribute().value(), "7");
}

TEST_F(Goldens, DamagedGoldenIsNamedWithItsLine) {
    edit("s/small.golden", "\"history\":", "\"history\" ");
    const Result result = call({"test"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, testing::ContainsRegex("s/small.golden:[0-9]+: "));
    const Result accept = call({"accept", "s/small.lua", "--because", "repair"});
    EXPECT_EQ(accept.code, 2);
    EXPECT_THAT(accept.out, HasSubstr("s/small.golden:"));
    EXPECT_EQ(call({"golden", "list"}).code, 2);
}

TEST_F(Goldens, AcceptTakesOnlyWhatItShould) {
    const auto files = folder_.files();
    const std::string golden = read_file(folder_ / "s/small.golden");
    const auto refused = [&](int code, const std::vector<std::string>& words, const char* said) {
        std::vector<std::string> all{"accept"};
        all.insert(all.end(), words.begin(), words.end());
        const Result result = call(all);
        EXPECT_EQ(result.code, code) << result.out;
        EXPECT_THAT(result.out, HasSubstr(said));
    };
    refused(1, {"s/small.lua", "--because", "again"}, "there is nothing to accept");
    refused(2, {"s/small.lua"}, "--because");
    refused(2, {"s/small.lua", "--because", " \n"}, "--because");
    refused(2, {"--because", "all of them"}, "scenarios");
    refused(2, {"s", "--because", "all of them"}, "a folder");
    refused(2, {"s/smal.lua", "--because", "x"}, "no such scenario");
    refused(2, {"s/small.lua", "s/small.golden", "--because", "x"}, "named twice");
    refused(2, {"s/small.lua", "--seed", "3", "--because", "x"}, "--case");
    refused(2, {"s/small.lua", "--case", "late", "--because", "x"}, "what makes it different");
    refused(2, {"s/small.lua", "--case", "a/b", "--seed", "3", "--because", "x"}, "'a/b'");
    refused(2, {"s/small.lua", "--case", "a", "--set", "gpa=1", "--because", "x"}, "gpa");
    EXPECT_EQ(folder_.files(), files);
    EXPECT_EQ(read_file(folder_ / "s/small.golden"), golden);
}

TEST_F(Goldens, AcceptWritesAllOrNone) {
    write_file(folder_ / "s/new.lua", small_scenario);
    const Result result = call({"accept", "s/new.lua", "s/small.lua", "--because", "both"});
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.out, HasSubstr("nothing was written"));
    EXPECT_FALSE(fs::exists(folder_ / "s/new.golden"));
}

TEST_F(Goldens, WhatIsNoScenarioIsPassedOverOrRefused) {
    write_file(folder_ / "s/tools.lua", "-- helps scenario files\nreturn { two = 2 }\n");
    const Result folder = call({"test"});
    EXPECT_EQ(folder.code, 0) << folder.out;
    EXPECT_THAT(folder.out, HasSubstr("s/tools.lua is not a scenario: passed over"));
    const Result named = call({"test", "s/tools.lua"});
    EXPECT_EQ(named.code, 2);
    EXPECT_THAT(named.out, HasSubstr("s/tools.lua: not a scenario"));
    EXPECT_EQ(call({"test", "s/none.lua"}).code, 2);
    EXPECT_EQ(call({"test", "bin"}).code, 2);
    fs::create_directory(folder_ / "empty");
    EXPECT_EQ(call({"test", "empty"}).code, 2);
}

}  // namespace
}  // namespace reprise::test
