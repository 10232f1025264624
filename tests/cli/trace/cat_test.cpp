#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/cli/program.h"
#include "towns/network/network.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// One second with a few cars and two actors.
class Cat : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = new Folder;
        write_file(*folder / "two.lua",
                   "return scenario 'two' { town = 'town1', cars = 3, run = function()\n"
                   "  spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' }\n"
                   "  spawn{ name = 'other', model = 'van', driver = 'autopilot' }\n"
                   "  print('a, \"b\"')\n  wait(9)\nend }");
        const Result run =
            reprise({"run", *folder / "two.lua", "-o", *folder / "a.mcap", "--for", "1"});
        ASSERT_EQ(run.code, 0) << run.out;
    }

    static void TearDownTestSuite() { delete folder; }

    static Result cat(std::vector<std::string> words) {
        words.insert(words.begin(), {"cat", "a.mcap"});
        return reprise(words, folder->path());
    }

    static long lines(const Result& result) {
        return std::count(result.out.begin(), result.out.end(), '\n');
    }

    static Folder* folder;
};

Folder* Cat::folder = nullptr;

TEST_F(Cat, PrintsALineForEachStreamOfATick) {
    EXPECT_EQ(lines(cat({})), 2 * 20);
    EXPECT_EQ(lines(cat({"--topic", "tick"})), 20);
    EXPECT_THAT(cat({"--topic", "traffic", "--ticks", "3"}).out,
                StartsWith("{\"topic\":\"/sim/traffic\",\"tick\":\"3\",\"time\":0.15,\"cars\":[{"));
}

TEST_F(Cat, TakesTicksAndTimes) {
    for (const char* range : {"3..5", "0.15s..0.25s", "3..0.25s"})
        EXPECT_EQ(cat({"--ticks", range}).out, cat({"--ticks", "3..5"}).out);
    EXPECT_EQ(lines(cat({"--ticks", "19..", "--topic", "tick"})), 2);
    EXPECT_EQ(lines(cat({"--ticks", "..4", "--topic", "tick"})), 4);
}

TEST_F(Cat, AnActorIsTheSameByNameAndById) {
    const Result by_name = cat({"--actor", "other", "--ticks", "7"});
    EXPECT_EQ(by_name.out, cat({"--actor", "2", "--ticks", "7"}).out);
    EXPECT_THAT(by_name.out, HasSubstr("\"id\":2"));
    EXPECT_THAT(by_name.out, testing::Not(HasSubstr("\"id\":1")));
}

/// The same numbers by two ways through the reflection.
TEST_F(Cat, CsvHoldsTheNumbersOfTheJsonLines) {
    const Result csv =
        cat({"--format", "csv", "--actor", "ego", "--ticks", "9", "--fields", "vehicles.position"});
    EXPECT_THAT(
        csv.out,
        StartsWith("tick,time [s],position_x [m],position_y [m],position_z [m],id,name\n9,0.45,"));
    const Result json = cat({"--actor", "ego", "--ticks", "9", "--fields", "vehicles.position"});
    std::string numbers = csv.out.substr(csv.out.find("0.45,") + 5);
    for (const char* key : {"\"x\":", "\"y\":", "\"z\":"}) {
        const std::string number = numbers.substr(0, numbers.find(','));
        numbers.erase(0, number.size() + 1);
        EXPECT_THAT(json.out, HasSubstr(key + number));
    }
}

TEST_F(Cat, CsvQuotesWhatNeedsIt) {
    EXPECT_THAT(cat({"--format", "csv", "--fields", "events.text"}).out,
                HasSubstr(",\"a, \"\"b\"\"\",\n"));
    EXPECT_THAT(cat({"--fields", "events.text"}).out, HasSubstr("\"a, \\\"b\\\"\""));
}

TEST_F(Cat, EveryTableHasAsManyCellsInARowAsColumns) {
    for (const char* table : {"ticks",
                              "vehicles",
                              "wheels",
                              "controls",
                              "measurements",
                              "signals",
                              "commands",
                              "cars"}) {
        const Result csv = cat({"--format", "csv", "--fields", table, "--ticks", "1"});
        ASSERT_EQ(csv.code, 0) << csv.out;
        ASSERT_GE(lines(csv), 2) << table;
        const auto header = csv.out.substr(0, csv.out.find('\n'));
        auto row = csv.out.substr(header.size() + 1);
        row.resize(row.find('\n'));
        if (row.find('"') != std::string::npos)
            continue;  // a cell with a comma in it
        EXPECT_EQ(std::count(header.begin(), header.end(), ','),
                  std::count(row.begin(), row.end(), ','))
            << table;
    }
}

TEST_F(Cat, EndsQuietlyWhenTheReaderHasEnough) {
    const std::string program = REPRISE_PROGRAM;
    const std::string errors = *folder / "errors";
    const std::string command = "trap '' PIPE; '" + program + "' cat '" + (*folder / "a.mcap") +
                                "' 2>'" + errors + "' | head -c 10 >/dev/null";
    EXPECT_EQ(run_program("bash", {"-c", command}).code, 0);
    EXPECT_EQ(read_file(errors), "");
}

TEST_F(Cat, MistakesAreToldInOneLineWithASuggestion) {
    struct Mistake {
        std::vector<std::string> words;
        const char* said;
    };

    for (const Mistake& mistake :
         {Mistake{{"--actor", "oter"}, "no actor 'oter' (did you mean 'other'?)"},
          Mistake{{"--actor", "77"}, "no actor '77'; the scenario's are ego, other"},
          Mistake{{"--fields", "vehicle.position"}, "(did you mean 'vehicles.position'?)"},
          Mistake{{"--fields", "cars.speed", "--format", "csv", "--ticks", "99"}, "holds 1 to 20"},
          Mistake{{"--ticks", "0.5..1"}, "--ticks 0.5: ticks or seconds? Write 0.5s for seconds"},
          Mistake{{"--ticks", "5..x"}, "expected a tick such as 120t or a time such as 2.5s"},
          Mistake{{"--format", "csv"}, "choose it by --fields: ticks, "},
          Mistake{{"--format", "csv", "--fields", "cars,wheels"}, "not of 'cars'"},
          Mistake{{"--topic", "trafic"}, "did you mean 'traffic'?"}}) {
        const Result result = cat(mistake.words);
        EXPECT_EQ(result.code, 2);
        EXPECT_EQ(lines(result), 1) << result.out;
        EXPECT_THAT(result.out, HasSubstr(mistake.said));
    }
}

TEST_F(Cat, GetGivesTheScenarioBackAndTheNetworkAsItWasLoaded) {
    EXPECT_EQ(reprise({"get", "a.mcap", "scenario"}, folder->path()).out,
              read_file(*folder / "two.lua"));
    EXPECT_EQ(reprise({"get", "a.mcap", "network"}, folder->path()).out,
              towns::load_network(source("scenarios/towns/town1/town1.net.xml")).xml);
}

TEST_F(Cat, GetWritesFilesAndNeverOverItsInput) {
    ASSERT_EQ(reprise({"get", "a.mcap", "tick.bfbs", "-o", "t.bfbs"}, folder->path()).code, 0);
    EXPECT_EQ(read_file(*folder / "t.bfbs").substr(4, 4), "BFBS");
    const std::string before = read_file(*folder / "a.mcap");
    const Result over = reprise({"get", "a.mcap", "town", "-o", "./a.mcap"}, folder->path());
    EXPECT_EQ(over.code, 2);
    EXPECT_TRUE(read_file(*folder / "a.mcap") == before);
    const Result unknown = reprise({"get", "a.mcap", "netwerk"}, folder->path());
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.out, HasSubstr("did you mean 'network'?"));
}

TEST_F(Cat, ExportWritesWhatCatPrints) {
    const std::string out = *folder / "tables";
    ASSERT_EQ(reprise({"export", "a.mcap", "--to", "csv", "-o", out}, folder->path()).code, 0);
    for (const char* table : {"ticks", "vehicles", "events", "cars", "walkers"})
        EXPECT_EQ(read_file(out + "/" + table + ".csv"),
                  cat({"--format", "csv", "--fields", table}).out)
            << table;
    const std::string lines_of_all = *folder / "a.jsonl";
    ASSERT_EQ(
        reprise({"export", "a.mcap", "--to", "jsonl", "-o", lines_of_all}, folder->path()).code, 0);
    EXPECT_EQ(read_file(lines_of_all), cat({}).out);
}

TEST_F(Cat, QueryAnswersInBothFormats) {
    const std::string sql = "select max(tick) as last, count(*) as n from vehicles";
    EXPECT_EQ(reprise({"query", "a.mcap", sql}, folder->path()).out, "last,n\n20,40\n");
    EXPECT_EQ(reprise({"query", "a.mcap", sql, "--format", "jsonl"}, folder->path()).out,
              "{\"last\":20,\"n\":40}\n");
    EXPECT_THAT(reprise({"query", "a.mcap"}, folder->path()).out,
                HasSubstr("measurements(tick, time, speed, "));
}

/// Two routes to the same numbers: counting in C++, and SQL.
TEST_F(Cat, StatsAgreeWithSql) {
    const Result stats = reprise({"stats", "a.mcap", "--json"}, folder->path());
    const Result sql = reprise({"query",
                                "a.mcap",
                                "--format",
                                "jsonl",
                                "select max(speed) as max_speed, max(-acceleration) as "
                                "max_deceleration from measurements where actor = 1"},
                               folder->path());
    ASSERT_EQ(sql.code, 0) << sql.out;
    const std::string numbers = sql.out.substr(1, sql.out.find('}') - 1);
    const std::size_t comma = numbers.find(',');
    EXPECT_THAT(stats.out, HasSubstr(numbers.substr(0, comma)));
    EXPECT_THAT(stats.out, HasSubstr(numbers.substr(comma + 1)));
    EXPECT_THAT(reprise({"stats", "a.mcap"}, folder->path()).out, HasSubstr("other (2), van"));
}

}  // namespace
}  // namespace reprise::test
