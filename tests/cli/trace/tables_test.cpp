// Tables that a person reads: names, units, lengths, one reference point.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <tuple>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

using Row = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');)
        found.push_back(cell);
    return found;
}

/// Of a file without quoted cells.
std::vector<Row> rows_of(const std::string& csv) {
    std::istringstream text(csv);
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> heading = cells(line);
    std::vector<Row> rows;
    while (std::getline(text, line)) {
        const std::vector<std::string> values = cells(line);
        Row row;
        for (std::size_t i = 0; i < heading.size(); ++i)
            row[heading[i]] = i < values.size() ? values[i] : "";
        rows.push_back(row);
    }
    return rows;
}

double number(const Row& row, const std::string& column) {
    EXPECT_TRUE(row.contains(column)) << column;
    return row.contains(column) ? std::atof(row.at(column).c_str()) : 0;
}

/// An ego with mass behind a van of the traffic, which print their gap as Lua sees it.
class Tables : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = new Folder;
        write_file(*folder / "gap.lua",
                   "return scenario 'gap' { town = 'straight', duration = 3, run = function()\n"
                   "  local lead = spawn{ name = 'lead', model = 'van', driver = 'traffic',\n"
                   "                      lane = 'east_1', s = 180, speed = 12 }\n"
                   "  local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot',\n"
                   "                     lane = 'east_1', s = 100, speed = 15 }\n"
                   "  wait(2)\n"
                   "  print(string.format('%d %.9f %.9f', tick(), gap(ego, lead), ego:s()))\n"
                   "  wait(9)\nend }");
        const Result run = reprise({"run", *folder / "gap.lua", "-o", *folder / "a.mcap"});
        ASSERT_EQ(run.code, 0) << run.out;
        std::istringstream said(run.out.substr(run.out.find(" s  ") + 4));
        said >> tick >> gap >> ego_s;
    }

    static void TearDownTestSuite() { delete folder; }

    static std::string csv(const std::vector<std::string>& words) {
        std::vector<std::string> all{"cat", "a.mcap", "--format", "csv", "--fields"};
        all.insert(all.end(), words.begin(), words.end());
        const Result result = reprise(all, folder->path());
        EXPECT_EQ(result.code, 0) << result.out;
        return result.out;
    }

    static Row row(const std::string& table, const std::string& actor) {
        const auto rows = rows_of(csv({table, "--actor", actor, "--ticks", std::to_string(tick)}));
        EXPECT_EQ(rows.size(), 1U) << table;
        return rows.empty() ? Row{} : rows.front();
    }

    static Folder* folder;
    static int tick;
    static double gap;
    static double ego_s;
};

Folder* Tables::folder = nullptr;
int Tables::tick = 0;
double Tables::gap = 0;
double Tables::ego_s = 0;

/// Three ways: Lua's gap, the places along the lane, and the places in the world.
TEST_F(Tables, AGapFromTheTablesIsTheGapThatTheScenarioSees) {
    const Row ego = row("measurements", "ego");
    const Row lead = row("cars", "lead");
    ASSERT_EQ(ego.at("lane_name"), "east_1");
    ASSERT_EQ(lead.at("lane_name"), "east_1");
    const double along =
        number(lead, "front_s [m]") - number(lead, "length [m]") - number(ego, "front_s [m]");
    EXPECT_NEAR(along, gap, 0.01);
    const double axles = number(lead, "rear_axle_s [m]") - number(ego, "rear_axle_s [m]");
    const Row body = row("vehicles", "ego");
    const double apart = number(lead, "position_x [m]") - number(body, "position_x [m]");
    EXPECT_NEAR(axles, apart, 0.01) << "the road runs east";
    EXPECT_NEAR(number(ego, "rear_axle_s [m]"), ego_s, 0.01) << "what Lua calls s";
}

TEST_F(Tables, TellWhoAndWhatInWords) {
    const Row ego = row("measurements", "ego");
    EXPECT_EQ(ego.at("name"), "ego");
    EXPECT_EQ(ego.at("model_name"), "sedan");
    EXPECT_GT(number(ego, "speed [m/s]"), 10);
    EXPECT_GT(number(ego, "width [m]"), 1.5);
    const Row lead = row("cars", "lead");
    EXPECT_EQ(lead.at("name"), "lead");
    EXPECT_EQ(lead.at("model_name"), "van");
    EXPECT_NEAR(number(row("vehicles", "ego"), "time [s]"), tick * 0.05, 1e-9);
    EXPECT_THAT(csv({"events", "--ticks", "1"}), HasSubstr(",lead"));
}

TEST_F(Tables, LanesStandBehindTheirNumbers) {
    const Row ego = row("measurements", "ego");
    int found = 0;
    for (const Row& lane : rows_of(csv({"lanes"}))) {
        if (lane.at("number") != ego.at("lane"))
            continue;
        ++found;
        EXPECT_EQ(lane.at("name"), "east_1");
        EXPECT_EQ(lane.at("kind"), "driving");
        EXPECT_EQ(lane.at("left"), "east_2");
        EXPECT_GT(number(lane, "length [m]"), 3000);
        EXPECT_NEAR(number(lane, "speed_limit [m/s]"), 130 / 3.6, 0.01);
    }
    EXPECT_EQ(found, 1);
}

TEST_F(Tables, ActorsTellTheirNamesSizesAndTimes) {
    int found = 0;
    for (const Row& actor : rows_of(csv({"actors"}))) {
        if (actor.at("name") != "ego" && actor.at("name") != "lead")
            continue;
        ++found;
        EXPECT_EQ(actor.at("kind"), actor.at("name") == "ego" ? "vehicle" : "car");
        EXPECT_EQ(actor.at("model"), actor.at("name") == "ego" ? "sedan" : "van");
        EXPECT_GT(number(actor, "length [m]"), 4);
        EXPECT_EQ(actor.at("spawned [s]"), "0.05");
        EXPECT_EQ(actor.at("despawned [s]"), "");
    }
    EXPECT_EQ(found, 2);
}

TEST_F(Tables, OfTheWholeTraceTakeNoTicks) {
    const Result result = reprise(
        {"cat", "a.mcap", "--format", "csv", "--fields", "lanes", "--ticks", "3"}, folder->path());
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("--fields lanes: a table of the whole trace"));
}

TEST_F(Tables, SqlJoinsNamesToNumbers) {
    const Result result =
        reprise({"query",
                 "a.mcap",
                 "select a.name, l.name, m.model_name from measurements m join actors a on a.id = "
                 "m.actor join lanes l on l.number = m.lane where m.tick = 20"},
                folder->path());
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.out, HasSubstr("ego,east_1,sedan\n"));
}

TEST_F(Tables, AnExportHasThemToo) {
    const Result result = reprise({"export", "a.mcap", "--to", "csv", "-o", "out"}, folder->path());
    EXPECT_EQ(result.code, 0) << result.out;
    for (const char* name : {"lanes", "actors", "vehicles", "events"})
        EXPECT_GT(rows_of(read_file(*folder / "out/" + name + ".csv")).size(), 1U) << name;
}

TEST_F(Tables, VehiclesTellWhereTheyAreAlongTheirLaneAsMeasurementsDo) {
    const Row body = row("vehicles", "ego");
    const Row measured = row("measurements", "ego");
    for (const char* column : {"lane_name", "rear_axle_s [m]", "front_s [m]"}) {
        ASSERT_TRUE(body.contains(column)) << column;
        EXPECT_EQ(body.at(column), measured.at(column)) << column;
    }
    const Result sql =
        reprise({"query", "a.mcap", "select lane_name, front_s - rear_axle_s > 2 from vehicles"},
                folder->path());
    EXPECT_THAT(sql.out, HasSubstr("east_1,1\n"));
    const Result old = reprise({"query", "a.mcap", "select lane_s from vehicles"}, folder->path());
    EXPECT_EQ(old.code, 2);
    EXPECT_THAT(old.out, HasSubstr("no such column: lane_s (it is rear_axle_s or front_s [m]"));
}

TEST_F(Tables, AnExportOfOneActorHasItsRowsOnly) {
    const auto made = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"export", "a.mcap"};
        words.insert(words.end(), more.begin(), more.end());
        return reprise(words, folder->path());
    };
    ASSERT_EQ(made({"--to", "csv", "-o", "one", "--actor", "lead"}).code, 0);
    const auto rows = [&](const std::string& table) {
        return rows_of(read_file(*folder / ("one/" + table + ".csv")));
    };
    EXPECT_EQ(rows("vehicles").size(), 0U) << "lead has no mass";
    EXPECT_EQ(rows("cars").size(), 60U);
    for (const Row& car : rows("cars"))
        EXPECT_EQ(car.at("name"), "lead");
    ASSERT_EQ(rows("actors").size(), 1U);
    EXPECT_EQ(rows("actors").front().at("name"), "lead");
    EXPECT_GT(rows("lanes").size(), 1U) << "what stands behind the numbers";
    EXPECT_FALSE(std::filesystem::exists(*folder / "one/signals.csv")) << "they are nobody's";
    // The same rows as those that cat tells.
    EXPECT_EQ(read_file(*folder / "one/events.csv"), csv({"events", "--actor", "lead"}));
    ASSERT_EQ(made({"--to", "jsonl", "-o", "one.jsonl", "--actor", "lead"}).code, 0);
    EXPECT_EQ(read_file(*folder / "one.jsonl"),
              reprise({"cat", "a.mcap", "--actor", "lead"}, folder->path()).out);
}

TEST_F(Tables, AnExportOfNobodySaysWhoThereIs) {
    for (const auto& [format, actor, said] :
         {std::tuple{"csv", "egon", "no actor 'egon' (did you mean 'ego'?)"},
          std::tuple{"jsonl", "bicycle", "no actor 'bicycle'; the scenario's are ego, lead"},
          std::tuple{"foxglove", "ego", "--actor: only of --to csv and --to jsonl"}}) {
        const Result result = reprise(
            {"export", "a.mcap", "--to", format, "-o", "nobody", "--actor", actor}, folder->path());
        EXPECT_EQ(result.code, 2) << format;
        EXPECT_THAT(result.out, HasSubstr(said)) << format;
        EXPECT_FALSE(std::filesystem::exists(*folder / "nobody")) << format;
    }
}

TEST_F(Tables, ScenesTakePointsOnlyFromWhereTheirPlaceIsSaid) {
    ASSERT_EQ(reprise({"render", "a.mcap", "-o", "seen", "--sensor", "lidar", "--ticks", "20..20"},
                      folder->path())
                  .code,
              0);
    const auto scenes = [&](const std::string& out) {
        return reprise({"export", "a.mcap", "--to", "foxglove", "-o", out, "--images", "seen"},
                       folder->path());
    };
    const Result good = scenes("good.mcap");
    EXPECT_EQ(good.code, 0) << good.out;
    EXPECT_THAT(good.out, HasSubstr("and 1 point cloud"));
    // A camera beside it, whose pictures lie in the same folder.
    ASSERT_EQ(reprise({"render",
                       "a.mcap",
                       "-o",
                       "seen",
                       "--sensor",
                       "rgb,lidar",
                       "--size",
                       "32x24",
                       "--ticks",
                       "20..20"},
                      folder->path())
                  .code,
              0);
    const Result both = scenes("both.mcap");
    EXPECT_EQ(both.code, 0) << both.out;
    EXPECT_THAT(both.out, HasSubstr("and 1 point cloud"));
    const Result nowhere = scenes("no/such.mcap");
    EXPECT_EQ(nowhere.code, 2);
    EXPECT_THAT(nowhere.out, HasSubstr("no/such.mcap: cannot write the export"));
    const std::string points = read_file(*folder / "seen/000020.ply");
    write_file(*folder / "seen/000020.ply", points + "x");
    EXPECT_EQ(scenes("bad.mcap").out,
              "reprise: seen/000020.ply: these are no points that reprise render wrote\n");
    write_file(*folder / "seen/000020.ply", points);
    std::filesystem::remove(*folder / "seen/manifest.json");
    EXPECT_EQ(
        scenes("bad.mcap").out,
        "reprise: seen: manifest.json does not say where what measured its points was: render it "
        "again\n");
    EXPECT_FALSE(std::filesystem::exists(*folder / "bad.mcap"));
    EXPECT_FALSE(std::filesystem::exists(*folder / "bad.mcap.partial"));
}

/// Another seed of the traffic: its cars differ from the start, who stands alone does not.
TEST_F(Tables, ADiffOfOneActorIsAboutItAlone) {
    write_file(*folder / "two.lua",
               "return scenario 'two' { town = 'straight', duration = 3, params = { v = 12 },\n"
               "run = function(p)\n"
               "  local far = spawn{ name = 'far', model = 'sedan', driver = 'autopilot',\n"
               "                     lane = 'east_0', s = 2000, speed = 10 }\n"
               "  local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot',\n"
               "                     lane = 'east_1', s = 100, speed = 12 }\n"
               "  wait(1)\n  ego:set_speed(p.v)\n  wait(9)\nend }");
    for (const char* v : {"12", "6"})
        ASSERT_EQ(
            reprise(
                {"run", "two.lua", "-o", std::string(v) + ".mcap", "--set", std::string("v=") + v},
                folder->path())
                .code,
            0);
    const auto diff = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"diff", "12.mcap", "6.mcap"};
        words.insert(words.end(), more.begin(), more.end());
        return reprise(words, folder->path());
    };
    EXPECT_EQ(diff({}).code, 1);
    const Result far = diff({"--actor", "far"});
    EXPECT_EQ(far.code, 0) << far.out;
    EXPECT_THAT(far.out, HasSubstr("far is equal: 60 ticks\n"));
    const Result ego = diff({"--actor", "ego"});
    EXPECT_EQ(ego.code, 1);
    EXPECT_THAT(ego.out, HasSubstr("ego is different\ntick 21 (1.05 s), stage scenario, ego (2)"));
    EXPECT_THAT(ego.out, HasSubstr("commands[0].speed"));
    EXPECT_EQ(diff({"--actor", "2"}).out.substr(2), ego.out.substr(4)) << "by its id";
    const Result all = diff({"--actor", "ego", "--all"});
    EXPECT_THAT(all.out, HasSubstr("all differences of tick 21: "));
    EXPECT_THAT(all.out, testing::Not(HasSubstr("digests.")));
    EXPECT_EQ(diff({"--actor", "ego", "--tolerance", "1000"}).code, 0);
    const Result json = diff({"--actor", "far", "--json"});
    EXPECT_THAT(json.out, HasSubstr("\"result\": \"equal\""));
    const Result nobody = diff({"--actor", "egon"});
    EXPECT_EQ(nobody.code, 2);
    EXPECT_THAT(nobody.out, HasSubstr("no actor 'egon' (did you mean 'ego'?)"));
}

TEST_F(Tables, AnOptionThatIsNoneNamesTheOneThatIs) {
    const Result result = reprise({"stats", "a.mcap", "--tick", "3"}, folder->path());
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("(did you mean '--ticks'?)"));
}

/// One spelling of options wherever an actor and ticks are chosen.
TEST_F(Tables, StatsTakeAnActorAndTicks) {
    const Result all = reprise({"stats", "a.mcap"}, folder->path());
    const Result some =
        reprise({"stats", "a.mcap", "--actor", "ego", "--ticks", "1s..2s"}, folder->path());
    EXPECT_EQ(some.code, 0) << some.out;
    EXPECT_THAT(all.out, HasSubstr("60 ticks, 3.00 s"));
    EXPECT_THAT(some.out, HasSubstr("21 ticks, 1.05 s"));
    EXPECT_THAT(some.out, HasSubstr("ego (2), sedan, 1.05 s"));
    EXPECT_EQ(reprise({"stats", "a.mcap", "--actor", "egon"}, folder->path()).code, 2);
}

TEST_F(Tables, ARunTakesAnotherWeatherAndFrictionAndSaysSoInItsTrace) {
    const auto run = [&](std::vector<std::string> words) {
        std::vector<std::string> all{"run", "gap.lua", "-o", "w.mcap", "--for", "0.2"};
        all.insert(all.end(), words.begin(), words.end());
        return reprise(all, folder->path());
    };
    EXPECT_EQ(run({"--weather", "hard_rain_sunset", "--friction", "0.4"}).code, 0);
    const Result info = reprise({"info", "w.mcap"}, folder->path());
    EXPECT_THAT(info.out, HasSubstr("  weather   hard_rain_sunset, road friction 0.4\n"));
    EXPECT_EQ(reprise({"verify", "w.mcap"}, folder->path()).code, 0);
    const Result unknown = run({"--weather", "hard_rain"});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.out, HasSubstr("hard_rain_"));
    EXPECT_EQ(run({"--friction", "0"}).code, 2);
}

}  // namespace
}  // namespace reprise::test
