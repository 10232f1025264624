#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Records a short drive.
std::string record(const Folder& folder,
                   const std::string& name,
                   const std::string& seed,
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"run",
                                   source("scenarios/free_drive.lua"),
                                   "-o",
                                   folder / name,
                                   "--seed",
                                   seed,
                                   "--for",
                                   "8"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = reprise(words);
    EXPECT_EQ(result.code, 0) << result.out;
    return folder / name;
}

TEST(Run, TwoProcessesWithOneSeedWriteTheSameBytes) {
    const Folder folder;
    const std::string one = record(folder, "a.mcap", "7");
    const std::string other = record(folder, "b.mcap", "7");
    EXPECT_TRUE(read_file(one) == read_file(other));
    const Result diff = reprise({"diff", one, other});
    EXPECT_EQ(diff.code, 0);
    EXPECT_THAT(diff.out, HasSubstr("equal: 160 ticks"));
}

TEST(Diff, NamesTickStageAndFieldOfAnotherSeed) {
    const Folder folder;
    const Result diff =
        reprise({"diff", record(folder, "a.mcap", "7"), record(folder, "b.mcap", "8")});
    EXPECT_EQ(diff.code, 1);
    EXPECT_THAT(diff.out, HasSubstr("tick 1"));
    EXPECT_THAT(diff.out, HasSubstr("stage"));
    EXPECT_THAT(diff.out, HasSubstr("field"));
    EXPECT_THAT(diff.out, HasSubstr("seed"));
}

TEST(Verify, NeedsNothingButTheTrace) {
    const Folder folder;
    const Folder empty;
    std::filesystem::copy(record(folder, "a.mcap", "7"), empty / "a.mcap");
    const Result verify = reprise({"verify", "a.mcap"}, empty.path());
    EXPECT_EQ(verify.code, 0) << verify.out;
    EXPECT_THAT(verify.out, HasSubstr("equal at every one of 160 ticks"));
    EXPECT_THAT(empty.files(), testing::ElementsAre("a.mcap"));
}

TEST(Verify, ReportsANudgedInputAtItsTick) {
    const Folder folder;
    const Result verify = reprise({"verify", record(folder, "a.mcap", "7", {"--nudge", "101"})});
    EXPECT_EQ(verify.code, 1);
    EXPECT_THAT(verify.out, HasSubstr("tick 101"));
    EXPECT_THAT(verify.out, HasSubstr("controls"));
    EXPECT_THAT(verify.out, HasSubstr("steer"));
}

TEST(Diff, ReportsANudgedInputAtItsTick) {
    const Folder folder;
    const Result diff = reprise(
        {"diff", record(folder, "a.mcap", "7"), record(folder, "b.mcap", "7", {"--nudge", "77"})});
    EXPECT_EQ(diff.code, 1);
    EXPECT_THAT(diff.out, HasSubstr("tick 77"));
    EXPECT_THAT(diff.out, HasSubstr("steer"));
}

TEST(Diff, OfTwoBuildsIsEqualWithinATolerance) {
    const Folder folder;
    const std::string base = record(folder, "a.mcap", "7");
    const std::string nudged = record(folder, "b.mcap", "7", {"--nudge", "131:ego.velocity.x"});
    const Result within = reprise({"diff", base, nudged, "--tolerance", "1e-3"});
    EXPECT_EQ(within.code, 0) << within.out;
    EXPECT_THAT(within.out,
                HasSubstr("equal within tolerance 0.001: 160 ticks, largest difference "));
    const Result outside = reprise({"diff", base, nudged, "--tolerance", "0", "--json"});
    EXPECT_EQ(outside.code, 1);
    EXPECT_THAT(outside.out, HasSubstr("\"result\": \"different\""));
    EXPECT_THAT(outside.out, HasSubstr("\"tick\": \"131\""));
    EXPECT_THAT(outside.out, HasSubstr("\"field\": \"vehicles[id 1].velocity.x\""));
    EXPECT_EQ(reprise({"diff", base, nudged, "--tolerance", "-1"}).code, 2);
    EXPECT_EQ(reprise({"diff", base, nudged, "--tolerance", "nan"}).code, 2);
}

/// A crash with all that a tick records; the numbers of the collisions are left open.
class InfoOfACrash : public testing::Test {
  protected:
    void SetUp() override {
        const Result run = reprise({"run",
                                    source("tests/cli/crash/crash.lua"),
                                    "--town",
                                    source("tests/cli/crash/small.net.xml"),
                                    "-o",
                                    trace_});
        EXPECT_EQ(run.code, 1) << run.out;
    }

    const Folder folder_;
    const std::string trace_ = folder_ / "crash.mcap";
};

TEST_F(InfoOfACrash, TellsARunOnOneScreen) {
    const Result info = reprise({"info", trace_});
    EXPECT_EQ(info.code, 0);
    EXPECT_LE(std::count(info.out.begin(), info.out.end(), '\n'), 24);
    for (const char* row : {"  town      small, 1 car of traffic\n",
                            "  seed      11\n",
                            "  outcome   failed: time limit\n",
                            "            failed  hit the van: it happened, at 2.25 s; worst 1.15 s "
                            "in all, until 3.30 s\n",
                            "            passed  hit the child\n",
                            " printed\n",
                            "  actors    ego (1), van (2), other (4), child (3), ",
                            "  again     reprise run ",
                            "crash.mcap\n"})
        EXPECT_THAT(info.out, HasSubstr(row));
    EXPECT_THAT(
        info.out,
        testing::ContainsRegex("crashes      2.20 s  ego hits van at [0-9.]+ m/s: [0-9,]+ N s, in "
                               "contact for [0-9.]+ s\n"));
    EXPECT_THAT(info.out, testing::ContainsRegex("  chain     [0-9a-f]{32}\n"));
    EXPECT_THAT(info.out, Not(HasSubstr("\033")));  // colours are for terminals
    EXPECT_THAT(info.out, Not(HasSubstr("libsumocpp")));
    EXPECT_THAT(reprise({"info", trace_, "--long"}).out, HasSubstr("libsumocpp "));
}

TEST_F(InfoOfACrash, NamesWhoWasThereBeforeASlice) {
    ASSERT_EQ(reprise({"slice", trace_, "--ticks", "40..60", "-o", folder_ / "part.mcap"}).code, 0);
    const Result info = reprise({"info", folder_ / "part.mcap"});
    EXPECT_THAT(info.out, HasSubstr("ego hits van"));
    EXPECT_THAT(info.out, HasSubstr("  actors    ego (1), van (2), "));
}

TEST_F(InfoOfACrash, IsJsonForPrograms) {
    const Result info = reprise({"info", trace_, "--json"});
    EXPECT_EQ(info.code, 0);
    for (const char* text : {"\"seed\": \"11\"",
                             "\"verdict\": \"failed\"",
                             "\"chain\": \"",
                             "\"count\": \"",
                             "\"throttle\": \"0.8\""})
        EXPECT_THAT(info.out, HasSubstr(text));
    const Folder folder;
    write_file(folder / "info.json", info.out);
    EXPECT_EQ(run_program("/usr/bin/python3", {"-m", "json.tool", folder / "info.json"}).code, 0);
}

/// The whole of an option's promise, through the programs.
TEST(Drill, OneUnitInOneNumberIsReportedAsExactlyThat) {
    const Folder folder;
    const std::string base = record(folder, "a.mcap", "7");
    const std::string nudged =
        record(folder, "b.mcap", "7", {"--nudge", "131:ego.angular_velocity.z"});
    for (const Result& report : {reprise({"verify", nudged}), reprise({"diff", base, nudged})}) {
        EXPECT_EQ(report.code, 1);
        for (const char* text : {"tick 131 (6.55 s), stage physics, ego (1)\n",
                                 "  field     vehicles[id 1].angular_velocity.z\n",
                                 " (0x",
                                 "  note      1 unit in the last place apart\n",
                                 "  script    last said at tick 1 (0.05 s): may_overtake of "
                                 "ego (1), free_drive.lua:"})
            EXPECT_THAT(report.out, HasSubstr(text));
    }
}

TEST(Drill, OfAVehicleThatTheScriptDrivesByHandIsFound) {
    const Folder folder;
    write_file(folder / "hand.lua",
               "return scenario 'hand' { town = 'town1', duration = 3, run = function()\n"
               "  local car = spawn{ name = 'car', model = 'sedan', driver = 'manual' }\n"
               "  car:control{ throttle = 0.4, steer = 0.1 }\n"
               "  wait(9)\nend }");
    const std::string trace = folder / "hand.mcap";
    const Result run =
        reprise({"run", folder / "hand.lua", "-o", trace, "--nudge", "40:car.throttle"});
    EXPECT_EQ(run.code, 0) << run.out;
    const Result verify = reprise({"verify", trace});
    EXPECT_EQ(verify.code, 1);
    for (const char* text :
         {"tick 40 (2.00 s), stage controls, car (1)", "throttle", "1 unit in the last place"})
        EXPECT_THAT(verify.out, HasSubstr(text));
}

TEST(Drill, ThatNeverCameIsSaid) {
    const Folder folder;
    write_file(folder / "short.lua",
               "return scenario 'short' { town = 'town1', run = function() wait(1) finish() end }");
    const Result run =
        reprise({"run", folder / "short.lua", "--nudge", "100:road_friction"}, folder.path());
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.out, HasSubstr("--nudge 100:road_friction: the run ended at tick"));
}

/// What a report says after "again".
std::string again(const Result& report) {
    const std::string key = "  again     ";
    const std::size_t at = report.out.find(key);
    EXPECT_NE(at, std::string::npos) << report.out;
    const std::size_t from = at + key.size();
    return at == std::string::npos ? ""
                                   : report.out.substr(from, report.out.find('\n', from) - from);
}

TEST(Again, IsACommandThatComesBackToTheDifference) {
    const Folder folder;
    const std::string scenario = folder / "it's my drive.lua";
    write_file(
        scenario,
        "return scenario 'drive' { town = 'town1', seed = 3, params = { text = 'a', n = 1 },\n"
        "run = function(p)\n"
        "  assert(p.text == \"it's $HOME; 'b'\" and p.n == 2)\n"
        "  spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' }\n"
        "  wait(9)\nend }");
    const auto run = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> words{"run",
                                       scenario,
                                       "-o",
                                       folder / name,
                                       "--for",
                                       "5",
                                       "--set",
                                       "n=2",
                                       "--set",
                                       "text=it's $HOME; 'b'"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = reprise(words);
        EXPECT_EQ(result.code, 0) << result.out;
    };
    run("base.mcap", {});
    run("-nudged one.mcap", {"--nudge", "40:ego.velocity.x"});

    // verify: the same command, the same report.
    const Result verify = reprise({"verify", "./-nudged one.mcap"}, folder.path());
    EXPECT_EQ(again(verify), "reprise verify './-nudged one.mcap'");
    EXPECT_EQ(typed(again(verify), folder).out, verify.out);

    // diff: both are simulated again, and the one that does not repeat is told.
    const Result diff = reprise({"diff", "./-nudged one.mcap", "base.mcap"}, folder.path());
    const std::string out = typed(again(diff), folder).out;
    EXPECT_THAT(out, HasSubstr("tick 40 (2.00 s), stage physics, ego (1)"));
    EXPECT_THAT(out, HasSubstr("1 unit in the last place apart"));
}

TEST(Run, MakesARecordedRunAgainFromTheTraceAlone) {
    const Folder folder;
    const std::string first = record(folder, "a.mcap", "7");
    const Result again = reprise({"run", "a.mcap"}, folder.path());
    EXPECT_EQ(again.code, 0) << again.out;
    EXPECT_TRUE(read_file(folder / "a_again.mcap") == read_file(first));
    const Result other = reprise({"run", "a.mcap", "--seed", "8", "-o", "b.mcap"}, folder.path());
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.out, HasSubstr("a recorded run is run again as it was"));
    EXPECT_THAT(folder.files(), testing::ElementsAre("a.mcap", "a_again.mcap"));
}

TEST(Run, WritesThroughALinkAndLeavesItOne) {
    const Folder folder;
    std::filesystem::create_directory(folder / "far");
    std::filesystem::create_symlink("far/real.mcap", folder / "link.mcap");
    record(folder, "link.mcap", "7");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.mcap"));
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "far/real.mcap"));
}

TEST(Verify, ReportsAFlippedBit) {
    const Folder folder;
    const std::string path = record(folder, "a.mcap", "7");
    std::string bytes = read_file(path);
    bytes[bytes.size() * 3 / 4] = static_cast<char>(bytes[bytes.size() * 3 / 4] ^ 4);
    write_file(path, bytes);
    const Result verify = reprise({"verify", path});
    EXPECT_EQ(verify.code, 1) << verify.out;
    EXPECT_THAT(verify.out, HasSubstr("tick"));
}

TEST(Info, SaysWhatRanAndHowToRunItAgain) {
    const Folder folder;
    const Result info = reprise({"info", record(folder, "a.mcap", "7")});
    EXPECT_EQ(info.code, 0);
    for (const char* word :
         {"free_drive", "town1", "seed", "100 cars", "clear_noon", "160 ticks", "again"})
        EXPECT_THAT(info.out, HasSubstr(word));
}

TEST(Run, EveryShippedScenarioPassesItsChecks) {
    const Folder folder;
    for (const char* scenario : {"cut_in", "child_runs_out"}) {
        const std::string name = std::string("scenarios/") + scenario + ".lua";
        const Result run = reprise({"run", source(name), "-o", folder / "t.mcap"});
        EXPECT_EQ(run.code, 0) << run.out;
        EXPECT_THAT(run.out, HasSubstr("passed"));
        EXPECT_THAT(run.out, Not(HasSubstr("FAIL")));
    }
}

TEST(Run, ExitsWithOneWhenACheckFailsOrHadNothingToLookAt) {
    const Folder folder;
    const auto code = [&](const std::string& check) {
        write_file(folder / "mine.lua",
                   "return scenario 'mine' { town = 'town2', cars = 0, duration = 0.5,\n"
                   "run = function() " +
                       check + " wait(1) end }");
        const Result run = reprise({"run", folder / "mine.lua", "-o", folder / "t.mcap"});
        EXPECT_THAT(run.out, HasSubstr(run.code == 0 ? "passed" : "failed"));
        return run.code;
    };
    EXPECT_EQ(code("check.never('late', function() return tick() > 100 end)"), 0);
    EXPECT_EQ(code("check.never('late', function() return tick() > 3 end)"), 1);
    EXPECT_EQ(code("check.max('nothing', function() end, 1)"), 1);
}

TEST(Run, SaysWhoIsBlockedAndDoesNotPass) {
    const Folder folder;
    write_file(folder / "mine.lua",
               R"(return scenario 'mine' { town = 'town1', cars = 0, duration = 75,
        run = function()
            local road = pick_lane{ length = 80 }
            spawn{ model = 'sedan', driver = 'parked', lane = road, s = 50 }
            spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', lane = road, s = 20 }
            check.never('blocked')
            wait(100)
        end })");
    const Result run = reprise({"run", folder / "mine.lua", "-o", folder / "t.mcap"});
    EXPECT_EQ(run.code, 1) << run.out;
    EXPECT_THAT(run.out, HasSubstr("ego is blocked since "));
    EXPECT_THAT(run.out, HasSubstr(": vehicle 1 is "));
    EXPECT_THAT(run.out, HasSubstr("; it would look for a way around with may_overtake = true"));
    EXPECT_THAT(run.out, HasSubstr("check failed: blocked: actor 2 since "));
    EXPECT_THAT(run.out, testing::ContainsRegex("ego stood for [67].* s of its 7. s"));
    const Result info = reprise({"info", folder / "t.mcap"});
    EXPECT_THAT(info.out, HasSubstr("blocked"));
    EXPECT_THAT(info.out, HasSubstr("ego since "));
}

TEST(Run, SaysWhoStandsAtTheEndOfItsRoad) {
    const Folder folder;
    write_file(folder / "nodes.xml",
               R"(<nodes><node id="a" x="0" y="0"/><node id="b" x="200" y="0"/></nodes>)");
    write_file(folder / "edges.xml", R"(<edges><edge id="out" from="a" to="b"/></edges>)");
    const std::string net = folder / "one.net.xml";
    const Result made = run_program(
        "netconvert", {"-n", folder / "nodes.xml", "-e", folder / "edges.xml", "-o", net});
    ASSERT_EQ(made.code, 0) << made.out;
    write_file(folder / "mine.lua",
               R"(return scenario 'mine' { town = 'town1', cars = 0, duration = 40,
        run = function()
            spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', lane = 'out_0', s = 50 }
            wait(100)
        end })");
    const Result run =
        reprise({"run", folder / "mine.lua", "--town", net, "-o", folder / "t.mcap"});
    EXPECT_EQ(run.code, 0) << run.out;
    const std::string said = "ego stands at the end of its road: out_0 leads nowhere";
    EXPECT_THAT(run.out, HasSubstr(said));
    EXPECT_EQ(run.out.find(said), run.out.rfind(said)) << "once";
}

TEST(Programs, TheThinOneLoadsNeitherSumoNorOpenCv) {
    const Result ldd = run_program("ldd", {REPRISE_PROGRAM});
    ASSERT_EQ(ldd.code, 0) << ldd.out;
    const std::string& libraries = ldd.out;
    for (const char* heavy : {"sumo", "opencv", "embree", "Bullet", "lua"})
        EXPECT_THAT(libraries, Not(HasSubstr(heavy)));
    EXPECT_LT(std::count(libraries.begin(), libraries.end(), '\n'), 15);
}

}  // namespace
}  // namespace reprise::test
