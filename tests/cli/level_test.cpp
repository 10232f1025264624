#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

/// Records a drive with a car that the script steers, SUMO's cars and walkers.
class Expand : public testing::Test {
  protected:
    void SetUp() override {
        write_file(folder_ / "mixed.lua", R"(
            return scenario 'mixed' { town = 'town1', cars = 10, seed = 3, run = function()
                local hand = spawn{ name = 'hand', model = 'sedan', driver = 'manual' }
                local ego = spawn{ name = 'ego', model = 'sedan' }
                local where = pick_lane{ sidewalk = true }
                local child = spawn{ model = 'child', lane = where, s = 5, offset = -3 }
                child:walk_to{ across = where }
                check.never('collision', function() return ego:collided() end)
                for i = 1, 100 do
                    hand:control{ throttle = 0.3, steer = i / 1000 }
                    wait_ticks(1)
                end
            end })");
        run({"run", "mixed.lua", "-o", "full.mcap"}, 0);
    }

    std::string run(const std::vector<std::string>& words, int code) {
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, code) << result.out;
        return result.out;
    }

    const Folder folder_;
};

TEST_F(Expand, GivesTheOriginalBackByteForByteFromEveryLevel) {
    const std::string full = read_file(folder_ / "full.mcap");
    for (const std::string level : {"inputs", "core", "keyed"}) {
        run({"strip", "full.mcap", "-o", level + ".mcap", "--level", level}, 0);
        EXPECT_LT(read_file(folder_ / (level + ".mcap")).size(), full.size());
        EXPECT_THAT(run({"verify", level + ".mcap"}, 0), HasSubstr("equal at every one of"));
        EXPECT_THAT(run({"info", level + ".mcap"}, 0), HasSubstr("level     " + level));
        EXPECT_THAT(run({"diff", "full.mcap", level + ".mcap"}, 0), HasSubstr("equal: "));
        run({"expand", level + ".mcap", "-o", "again.mcap"}, 0);
        EXPECT_TRUE(read_file(folder_ / "again.mcap") == full) << level;
    }
}

TEST_F(Expand, OfARunThatWasRecordedAtTheLevelIsTheSame) {
    run({"run", "mixed.lua", "-o", "small.mcap", "--level", "inputs"}, 0);
    run({"strip", "full.mcap", "-o", "stripped.mcap", "--level", "inputs"}, 0);
    EXPECT_TRUE(read_file(folder_ / "small.mcap") == read_file(folder_ / "stripped.mcap"));
    // A recorded run made again takes its inputs from there.
    run({"run", "small.mcap", "-o", "again.mcap"}, 0);
    EXPECT_TRUE(read_file(folder_ / "again.mcap") == read_file(folder_ / "full.mcap"));
}

TEST_F(Expand, LeavesNothingWhenATickComesOutDifferently) {
    run({"run",
         "mixed.lua",
         "-o",
         "nudged.mcap",
         "--level",
         "inputs",
         "--nudge",
         "70:ego.velocity.x"},
        0);
    const std::string out = run({"expand", "nudged.mcap", "-o", "wrong.mcap"}, 1);
    EXPECT_THAT(out, HasSubstr("tick 70 (3.50 s), stage physics"));
    EXPECT_THAT(out, HasSubstr("nothing was written"));
    for (const std::string& file : folder_.files())
        EXPECT_THAT(file, testing::Not(HasSubstr("wrong")));
}

TEST_F(Expand, IsNotNeededForWhatIsThere) {
    const auto cars = [&](const std::string& trace, int code) {
        return run({"query", trace, "select count(distinct tick) as ticks from cars"}, code);
    };
    run({"strip", "full.mcap", "-o", "core.mcap", "--level", "core"}, 0);
    run({"strip", "full.mcap", "-o", "keyed.mcap", "--level", "keyed"}, 0);
    run({"strip", "full.mcap", "-o", "inputs.mcap", "--level", "inputs"}, 0);
    const std::vector<std::string> vehicles{"--fields", "vehicles.position", "--format", "csv"};
    const auto places = [&](const std::string& trace) {
        return run({"cat", trace, vehicles[0], vehicles[1], vehicles[2], vehicles[3]}, 0);
    };
    EXPECT_EQ(places("core.mcap"), places("full.mcap"));
    EXPECT_EQ(places("keyed.mcap"), places("full.mcap"));
    EXPECT_THAT(run({"stats", "core.mcap"}, 0), HasSubstr("distance"));
    EXPECT_THAT(run({"cat", "inputs.mcap", "--ticks", "1"}, 0), HasSubstr("\"vehicles\":null"));
    EXPECT_THAT(cars("keyed.mcap", 0), HasSubstr("ticks\n6\n"));
    EXPECT_THAT(run({"cat", "keyed.mcap", "--topic", "traffic", "--ticks", "1..2"}, 0),
                HasSubstr("note: keyed.mcap holds traffic in ticks 1, 21, 41, ... only; "));
    run({"export", "core.mcap", "--to", "csv", "-o", "tables", "--every", "1s"}, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "tables/vehicles.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "tables/cars.csv"));
    const std::string ticks = read_file(folder_ / "tables/ticks.csv");
    EXPECT_THAT(ticks, HasSubstr("\n21,1.05,"));
    EXPECT_THAT(ticks, testing::Not(HasSubstr("\n2,0.1,")));

    const std::string hint = "core.mcap -o FULL.mcap` makes the rest again";
    EXPECT_THAT(cars("core.mcap", 2), HasSubstr(hint));
    EXPECT_THAT(run({"cat", "core.mcap", "--topic", "traffic"}, 2), HasSubstr(hint));
    EXPECT_THAT(run({"cat", "core.mcap", "--fields", "cars.speed"}, 2), HasSubstr(hint));
    EXPECT_THAT(run({"stats", "inputs.mcap"}, 2),
                HasSubstr("'vehicles' is not there: inputs.mcap"));
    EXPECT_THAT(run({"cat", "inputs.mcap", "--actor", "ego"}, 2), HasSubstr("'vehicles' is not"));
}

TEST_F(Expand, IsWhatOneIsToldToDoWhenThereIsNothingToSee) {
    run({"strip", "full.mcap", "-o", "s.mcap", "--level", "inputs"}, 0);
    const std::string hint = "s.mcap holds inputs only; `reprise expand s.mcap -o FULL.mcap` makes";
    EXPECT_THAT(run({"render", "s.mcap", "-o", "pictures", "--size", "8x6"}, 2), HasSubstr(hint));
    EXPECT_THAT(run({"strip", "s.mcap", "-o", "c.mcap", "--level", "core"}, 2), HasSubstr(hint));
    EXPECT_THAT(run({"strip", "full.mcap", "-o", "full.mcap", "--level", "core"}, 2),
                HasSubstr("full.mcap: the output is the input"));
    EXPECT_THAT(run({"strip", "full.mcap", "-o", "c.mcap", "--level", "cora"}, 2),
                HasSubstr("did you mean 'core'?"));
    // What is left in every 20th tick is what `render --every 1s` looks at.
    run({"strip", "full.mcap", "-o", "k.mcap", "--level", "keyed"}, 0);
    EXPECT_THAT(run({"render", "k.mcap", "-o", "some", "--size", "8x6"}, 0),
                HasSubstr("6 pictures"));
}

}  // namespace
}  // namespace reprise::test
