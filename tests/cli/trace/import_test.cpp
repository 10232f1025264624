#include <filesystem>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A recording of CARLA's recorder, imported.
class Importing : public testing::Test {
  protected:
    void SetUp() override {
        make_log({});
        const Result result = reprise({"import", "drive.log", "-o", "t.mcap"}, folder_.path());
        ASSERT_EQ(result.code, 0) << result.out;
        EXPECT_THAT(result.out, HasSubstr("poses only"));
    }

    void make_log(const std::vector<std::string>& options) {
        std::vector<std::string> words{
            source("tests/exchange/make_carla_log.py"), folder_ / "drive.log", "--seconds", "3"};
        words.insert(words.end(), options.begin(), options.end());
        const Result made = run_program("python3", words);
        ASSERT_EQ(made.code, 0) << made.out;
    }

    Result on_trace(std::vector<std::string> words) {
        words.insert(words.begin() + 1, "t.mcap");
        return reprise(words, folder_.path());
    }

    Folder folder_;
};

TEST_F(Importing, MakesATraceThatCanBeReadInEveryWay) {
    EXPECT_THAT(on_trace({"info"}).out, HasSubstr("CARLA recorder file drive.log"));
    EXPECT_THAT(on_trace({"info", "--json"}).out, HasSubstr("\"imported_from\": \"CARLA"));
    EXPECT_THAT(on_trace({"cat", "--actor", "hero", "--fields", "cars.speed"}).out,
                HasSubstr("speed"));
    EXPECT_THAT(on_trace({"get", "metadata"}).out, HasSubstr("imported_from"));
    EXPECT_EQ(on_trace({"stats"}).code, 0);
    EXPECT_EQ(on_trace({"slice", "--ticks", "10..20", "-o", "s.mcap"}).code, 0);
    EXPECT_EQ(on_trace({"diff", "t.mcap"}).code, 0);
    EXPECT_THAT(on_trace({"query", "select count(*) from cars where id = 24"}).out,
                HasSubstr("59"));
    EXPECT_EQ(on_trace({"export", "--to", "foxglove", "-o", "f.mcap"}).code, 0);
    EXPECT_THAT(folder_.files(), Contains("f.mcap"));
}

TEST_F(Importing, MakesATraceThatNobodySimulatesAgain) {
    const std::string scenario = source("scenarios/cut_in.lua");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"verify"},
          {"expand", "-o", "x.mcap"},
          {"branch", "--at", "10t", "--script", scenario, "-o", "x.mcap"},
          {"strip", "--level", "core", "-o", "x.mcap"},
          {"run", "-o", "x.mcap"}}) {
        const Result result = on_trace(words);
        EXPECT_EQ(result.code, 2) << words.front();
        EXPECT_THAT(result.out, HasSubstr("poses only, and cannot be simulated again"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "x.mcap")) << words.front();
    }
}

TEST_F(Importing, MakesATraceThatIsRenderedFromTheHero) {
    const Result result =
        on_trace({"render", "-o", "pictures", "--size", "64x48", "--every", "1s"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(folder_.files(), Contains("pictures/000021.png"));
}

TEST_F(Importing, MakesATraceWhoseHeroCarriesEverySensor) {
    const Result result = on_trace(
        {"render", "-o", "scans", "--sensor", "lidar,radar,gnss,imu,obstacle", "--every", "1s"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(folder_.files(), Contains("scans/lidar/000021.ply"));
    EXPECT_THAT(folder_.files(), Contains("scans/radar/000021.ply"));
    EXPECT_THAT(read_file(folder_ / "scans/gnss.csv"), HasSubstr("\n21,"));
}

TEST_F(Importing, SaysWhatACutOffLogLost) {
    make_log({"--cut", "100"});
    const Result result = reprise({"import", "drive.log", "-o", "cut.mcap"}, folder_.path());
    EXPECT_EQ(result.code, 3) << result.out;
    EXPECT_THAT(result.out, HasSubstr("bytes behind the last whole frame; byte"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "cut.mcap"));
}

TEST_F(Importing, RefusesWhatIsNoLogAndLeavesNothingBehind) {
    write_file(folder_ / "other.log", "Sat Nov 21 something happened");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"import", "other.log", "-o", "x.mcap"},
          {"import", "none.log", "-o", "x.mcap"},
          {"import", "drive.log", "-o", "x.mcap", "--step", "0.5"},
          {"import", "drive.log", "-o", "x.mcap", "--town", "nowhere"},
          {"import", "drive.log", "-o", "drive.log"}}) {
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, 2) << result.out;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "x.mcap"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "x.mcap.partial"));
    }
    EXPECT_THAT(reprise({"import", folder_.path().string(), "-o", "x.mcap"}, folder_.path()).out,
                HasSubstr("not a CARLA recorder log: this is a folder"));
}

}  // namespace
}  // namespace reprise::test
