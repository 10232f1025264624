// What a folder of pictures was made from, weathers that change, and what is left when a disk is
// full.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

/// A drive whose own weather changes evenly from 1 s to 2 s.
class Manifest : public testing::Test {
  protected:
    void SetUp() override {
        write_file(
            folder_ / "shower.lua",
            "return scenario 'shower' { town = 'town1', duration = 3, cars = 10,\n"
            "weather = { { at = 0, preset = 'clear_noon' },\n"
            "{ at = 1, over = 1, preset = 'hard_rain_sunset' } },\n"
            "run = function() spawn{ name = 'ego', model = 'sedan', lane = pick_lane{ length "
            "= 60 }, s = 8, speed_kmh = 20 } wait(2.9) end }\n");
        ASSERT_EQ(reprise({"run", "shower.lua", "-o", "t.mcap"}, folder_.path()).code, 0);
    }

    Result render(const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> words{"render", "t.mcap", "-o", out, "--size", "64x48"};
        words.insert(words.end(), more.begin(), more.end());
        return reprise(words, folder_.path());
    }

    std::string picture(const std::string& weather, const std::string& tick) {
        std::vector<std::string> words{"--ticks", tick};
        if (!weather.empty())
            words.insert(words.end(), {"--weather", weather});
        const Result made = render("p", words);
        EXPECT_EQ(made.code, 0) << made.out;
        return read_file(folder_ / ("p/0000" + tick + ".png"));
    }

    std::size_t files_in(const std::string& folder) const {
        std::size_t count = 0;
        for (const std::string& file : folder_.files())
            count += file.starts_with(folder + "/") ? 1 : 0;
        return count;
    }

    const Folder folder_;
};

TEST_F(Manifest, WeathersOverTimeAreThoseThatTheScenarioWouldHaveHad) {
    const std::string course = "clear_noon,1s:clear_noon,2s:hard_rain_sunset";
    // A script's change of 1 s begins with the tick before.
    for (const std::string tick : {"10", "20", "45", "55"})
        EXPECT_TRUE(picture("", tick) == picture(course, tick)) << tick;
    EXPECT_TRUE(picture(course, "40") == picture("hard_rain_sunset", "40"));
    EXPECT_TRUE(picture(course, "30") != picture("hard_rain_sunset", "30"));
    EXPECT_TRUE(picture(course, "30") != picture("clear_noon", "30"));
    EXPECT_TRUE(picture("recorded", "30") == picture("", "30"));
}

TEST_F(Manifest, ChangesOfAWeatherReachLidarsToo) {
    const auto points = [&](const std::string& weather) {
        const Result made = reprise({"render",
                                     "t.mcap",
                                     "-o",
                                     "l",
                                     "--sensor",
                                     "lidar",
                                     "--ticks",
                                     "40",
                                     "--weather",
                                     weather},
                                    folder_.path());
        EXPECT_EQ(made.code, 0) << made.out;
        return read_file(folder_ / "l/000040.ply");
    };
    const std::string rain = points("clear_noon,rain=50");
    EXPECT_TRUE(rain != points("clear_noon"));
    EXPECT_TRUE(rain == points("0s:clear_noon,1s:rain=50"));
}

TEST_F(Manifest, OfAFolderThatIsRenderedIntoAgainIsAwayUntilAllIsThereAndTellsWhatIsOfBefore) {
    EXPECT_EQ(render("p", {"--ticks", "10..50", "--every", "10t"}).code, 0);
    // Pictures of 1 kB at most cannot be written.
    const std::string again = "reprise render t.mcap -o p --weather clear_night --size 320x240";
    const Result stopped = typed("ulimit -f 1; exec " + again + " --ticks 20", folder_);
    EXPECT_EQ(stopped.code, 2) << stopped.out;
    EXPECT_THAT(folder_.files(), testing::Not(testing::Contains("p/manifest.json")));

    EXPECT_EQ(render("p", {"--ticks", "10..50", "--every", "10t"}).code, 0);
    const Result mixed = typed("exec " + again + " --ticks 20..50 --every 20t", folder_);
    EXPECT_EQ(mixed.code, 0) << mixed.out;
    EXPECT_THAT(
        mixed.out,
        HasSubstr("p: 3 files are left of an earlier rendering there, such as p/000010.png"));
    const Result anew = render("p", {"--ticks", "10..50", "--every", "20t"});
    EXPECT_THAT(anew.out, HasSubstr("files are left"));
    EXPECT_THAT(render("p", {"--ticks", "10..50", "--every", "20t"}).out,
                testing::Not(HasSubstr("left")));
}

TEST_F(Manifest, ChecksThatAllIsMadeAgainAndNamesTheFileThatIsNot) {
    write_file(folder_ / "rig.json",
               R"({"sensors": [{"name": "a", "size": [64, 48]}, {"name": "d", "type": "depth",
                  "size": [64, 48]}]})");
    ASSERT_EQ(reprise({"render",
                       "t.mcap",
                       "-o",
                       "r",
                       "--rig",
                       "rig.json",
                       "--ticks",
                       "20..24",
                       "--every",
                       "4",
                       "--boxes",
                       "--exr",
                       "--weather",
                       "rain=9"},
                      folder_.path())
                  .code,
              0);
    std::filesystem::remove(folder_ / "rig.json");
    const auto check = [&](const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"render", "--check", "r/manifest.json"};
        words.insert(words.end(), more.begin(), more.end());
        return reprise(words, folder_.path());
    };
    const std::size_t files =
        nlohmann::json::parse(read_file(folder_ / "r/manifest.json"))["files"].size();
    EXPECT_EQ(files + 1, files_in("r"));
    for (const std::string threads : {"1", "2"}) {
        const Result same = check({"--threads", threads});
        EXPECT_EQ(same.code, 0) << same.out;
        EXPECT_THAT(same.out, HasSubstr("files were made again, byte for byte"));
    }
    const std::string kept = read_file(folder_ / "r/d/000024.exr");
    write_file(folder_ / "r/d/000024.exr", kept + "x");
    EXPECT_THAT(check().out, HasSubstr("r/d/000024.exr: was changed since it was made"));
    EXPECT_EQ(check().code, 1);
    std::filesystem::remove(folder_ / "r/d/000024.exr");
    EXPECT_THAT(check().out, HasSubstr("r/d/000024.exr: is no longer there"));
    write_file(folder_ / "r/d/000024.exr", kept);
    // What it tells people is held as well.
    const std::string true_text = read_file(folder_ / "r/manifest.json");
    for (const auto& [key, lie] : {std::pair{"sensors", R"("fov_deg": 90.0)"},
                                   std::pair{"weather", R"("rain_mm_h": 9.0)"},
                                   std::pair{"ticks", R"("to": 24)"}}) {
        std::string lying = true_text;
        ASSERT_NE(lying.find(lie), std::string::npos) << lie << '\n' << true_text;
        lying.insert(lying.find(lie) + std::string(lie).size() - 1, "1");
        write_file(folder_ / "r/manifest.json", lying);
        const Result told = check();
        EXPECT_EQ(told.code, 1) << key;
        EXPECT_THAT(told.out, HasSubstr(std::string("r/manifest.json: its '") + key + "' is not"));
    }
    write_file(folder_ / "r/manifest.json", true_text);
    // As if another program, or another machine, had made it.
    std::string text = read_file(folder_ / "r/manifest.json");
    const std::string weather = "\"--weather\": \"rain=9\"";
    ASSERT_NE(text.find(weather), std::string::npos);
    text.replace(text.find(weather), weather.size(), "\"--weather\": \"rain=8\"");
    write_file(folder_ / "r/manifest.json", text);
    EXPECT_THAT(check().out, HasSubstr("r/a/000020.png: made again it has other bytes"));
    ASSERT_EQ(reprise({"run", source("scenarios/free_drive.lua"), "-o", "o.mcap", "--for", "1"},
                      folder_.path())
                  .code,
              0);
    const Result other = reprise({"render", "o.mcap", "--check", "r"}, folder_.path());
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.out,
                HasSubstr("reprise: o.mcap: this is not the trace of r, whose chain is "));
    write_file(folder_ / "bad.json", "{\"manifest\": 1}");
    const Result bad = reprise({"render", "--check", "bad.json"}, folder_.path());
    EXPECT_EQ(bad.out, "reprise: bad.json: this is no manifest that reprise render wrote\n");
    EXPECT_EQ(bad.code, 2);
}

TEST_F(Manifest, OfWhatWasKilledInTheMidstIsMissingAndItsCheckSaysSo) {
    for (const std::string out : {"r", "r.mp4"}) {
        const std::string words = "reprise render t.mcap --sensor rgb --size 320x240 -o " + out;
        typed(words +
                  " > told & killed=$!; for i in $(seq 200); do ls | grep -q '^r' && break; "
                  "sleep 0.05; done; kill -9 $killed; wait $killed",
              folder_);
        const Result result = reprise({"render", "--check", out}, folder_.path());
        EXPECT_EQ(result.code, 2);
        EXPECT_EQ(result.out,
                  "reprise: " + out + ": there is no " + out + (out == "r" ? "/" : ".") +
                      "manifest.json, which is written last: it is not whole\n");
        std::filesystem::remove_all(folder_ / "r");
        EXPECT_EQ(typed("exec " + words + " --ticks 20..23", folder_).code, 0);
        EXPECT_EQ(reprise({"render", "--check", out}, folder_.path()).code, 0);
        std::filesystem::remove_all(folder_ / "r");
    }
}

TEST_F(Manifest, OfADataSetTellsWhatItHolds) {
    ASSERT_EQ(typed("exec reprise dataset t.mcap -o s --size 64x48 --every 2s", folder_).code, 0);
    const std::string true_text = read_file(folder_ / "s/dataset.json");
    for (const auto& [key, told, lie] :
         {std::tuple{"cameras", R"("fov_deg": 82.0)", R"("fov_deg": 28.0)"},
          std::tuple{"weathers", R"("folder": "recorded")", R"("folder": "clear_noon")"},
          std::tuple{"frames", R"("tick": 41)", R"("tick": 42)"}}) {
        std::string lying = true_text;
        ASSERT_NE(lying.find(told), std::string::npos) << told << '\n' << true_text;
        lying.replace(lying.find(told), std::string(told).size(), lie);
        write_file(folder_ / "s/dataset.json", lying);
        const Result checked = reprise({"dataset", "--check", "s"}, folder_.path());
        EXPECT_EQ(checked.code, 1) << key;
        EXPECT_THAT(checked.out,
                    HasSubstr(std::string("s/dataset.json: its '") + key + "' is not"));
    }
}

TEST_F(Manifest, AndIndexesEndWhereTheyEndWhateverLiesBehindANul) {
    ASSERT_EQ(render("r", {"--ticks", "20"}).code, 0);
    const std::string dataset = "exec reprise dataset t.mcap -o s --size 64x48 --every 2s";
    ASSERT_EQ(typed(dataset, folder_).code, 0);
    const auto spoil = [&](const std::string& file) {
        write_file(folder_ / file, read_file(folder_ / file) + std::string("\0{", 2));
    };
    spoil("r/manifest.json");
    EXPECT_EQ(reprise({"render", "--check", "r"}, folder_.path()).out,
              "reprise: r/manifest.json: this is no manifest that reprise render wrote\n");
    spoil("s/dataset.json");
    const std::string refused =
        "reprise: s/dataset.json: this is no index that reprise dataset wrote\n";
    EXPECT_EQ(reprise({"dataset", "--check", "s"}, folder_.path()).out, refused);
    EXPECT_EQ(typed(dataset, folder_).out, refused);
}

TEST_F(Manifest, IsMissingWhereAFullDiskEndedTheMakingAndNoHalfPictureLooksWhole) {
    const Result full = typed(
        "ulimit -f 10; reprise render t.mcap -o r --sensor semantic,depth --size 320x240 --npy",
        folder_);
    EXPECT_EQ(full.code, 2) << full.out;
    EXPECT_THAT(full.out, HasSubstr("cannot write the "));
    EXPECT_EQ(std::count(full.out.begin(), full.out.end(), '\n'), 1) << full.out;
    for (const std::string& file : folder_.files()) {
        EXPECT_THAT(file, testing::Not(HasSubstr("partial")));
        EXPECT_THAT(file, testing::Not(HasSubstr("manifest")));
        EXPECT_THAT(file, testing::Not(testing::EndsWith(".npy"))) << "307,200 bytes each";
    }
    const std::string words = "reprise dataset t.mcap -o s --size 200x120 --every 1s";
    const Result stopped = typed("ulimit -f 20; " + words, folder_);
    EXPECT_EQ(stopped.code, 2) << stopped.out;
    const Result whole = typed(words, folder_);
    EXPECT_EQ(whole.code, 0) << whole.out;
    ASSERT_EQ(typed(words + "2", folder_).code, 2) << "another period";
    const std::string once = "cd s && find . -type f | sort | xargs cat | cksum";
    const std::string first = typed(once, folder_).out;
    std::filesystem::remove_all(folder_ / "s");
    ASSERT_EQ(typed(words, folder_).code, 0);
    EXPECT_EQ(typed(once, folder_).out, first);
}

TEST_F(Manifest, FoldersAreComparedSensorBySensor) {
    const std::vector<std::string> how{
        "--sensor", "rgb,depth", "--ticks", "20..24", "--every", "4"};
    const auto under = [&](const std::string& out, const std::string& weather) {
        std::vector<std::string> words = how;
        words.insert(words.end(), {"--weather", weather});
        ASSERT_EQ(render(out, words).code, 0);
    };
    under("noon", "clear_noon");
    under("again", "clear_noon");
    under("night", "clear_night");
    const auto diff = [&](const std::string& other) {
        return reprise({"diff", "noon", other}, folder_.path());
    };
    const std::string same = "depth: 2 files, identical\ndepth/view: 2 files, identical\n";
    EXPECT_EQ(diff("again").out, same + "rgb: 2 files, identical\n");
    EXPECT_EQ(diff("again").code, 0);
    const Result night = diff("night");
    EXPECT_EQ(night.code, 1);
    EXPECT_THAT(night.out, testing::StartsWith(same + "rgb: 2 files, 2 differ, PSNR "));
    EXPECT_THAT(night.out, testing::EndsWith("; first in 000020.png at x 0 y 0\n"));
    std::filesystem::remove(folder_ / "again/depth/000024.png");
    EXPECT_THAT(diff("again").out,
                testing::StartsWith("depth: 2 files, 0 differ, 1 in one of both only; first in "
                                    "000024.png\n"));
}

TEST_F(Manifest, MistakesAreOneLineAndLeaveNothing) {
    write_file(folder_ / "imu.json",
               R"({ "sensors": [ { "name": "front" }, { "name": "motion", "type": "imu" } ] })");
    std::filesystem::create_directories(folder_ / "holiday");
    write_file(folder_ / "holiday/beach.jpg", "sea");
    std::filesystem::create_directories(folder_ / "web");
    write_file(folder_ / "web/manifest.json", R"({ "name": "an app" })");
    const std::vector<std::string> before = folder_.files();
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"render t.mcap -o x --sensor rgb,,depth",
         "--sensor: between commas, or beside one, nothing stands in 'rgb,,depth'"},
        {"render t.mcap -o x --sensor=depth,", "nothing stands in 'depth,'"},
        {"render t.mcap -o x --attribute fov=60", "(did you mean '--fov'?)"},
        {"render t.mcap -o web", "web/manifest.json: is there and no manifest"},
        {"dataset t.mcap -o holiday", "holiday: holds beach.jpg, and is no data set"},
        {"render t.mcap -o x --weather 5s:clear_noon,3s:rain=3", "3s: the stop before is at 5s"},
        {"render t.mcap -o x --weather 5m:clear_noon", "expected a time from 0s to 86400s"},
        {"render t.mcap -o x --weather 0s:clear_nono", "did you mean 'clear_noon'?"},
        {"render t.mcap -o x --compare clear_noon,clear_night", "is of a film: -o run.mp4"},
        {"render t.mcap -o x.mp4 --compare clear_noon", "expected 2 to 8 weathers"},
        {"render t.mcap -o x.mp4 --compare clear_noon,nigth", "--compare: no weather 'nigth'"},
        {"render t.mcap -o x --exr --npy", "says what --npy says"},
        {"render t.mcap", "--output is required"},
        {"render -o x", "trace is required"},
        {"render --check t.mcap", "this is no manifest"},
        {"render --check no", "no: cannot be read"},
        {"render --check t.mcap --npy", "the manifest says it: without --npy"},
        {"diff . no", "no: expected a folder of pictures, as . is one"},
        {"diff t.mcap .", "t.mcap: expected a folder of pictures, as . is one"},
        {"dataset t.mcap -o x --weathers clear_noon,clear_noon", "'clear_noon' is there twice"},
        {"dataset t.mcap -o x --split train:0.5,val:0.2", "shares must be 1 together"},
        {"dataset t.mcap -o x --split train:2", "expected NAME:SHARE,..."},
        {"dataset t.mcap t.mcap -o x", "this trace is there twice"},
        {"dataset t.mcap -o x --rig no.json", "no.json: cannot be read"},
        {"dataset t.mcap -o x --rig imu.json",
         "imu.json: sensor 'motion': a data set holds what cameras, LiDARs and radars see"},
        {"dataset t.mcap -o x --format kiti", "did you mean 'kitti'?"},
        {"dataset t.mcap -o t.mcap/x", "cannot be made a folder"},
        {"dataset t.mcap -o x --every 0", "expected 1 tick at least"},
        {"dataset t.mcap", "--output is required"},
        {"dataset -o x", "traces is required"},
        {"dataset --check no", "no/dataset.json: cannot be read"},
        {"dataset --check x --every 5", "the manifest says it: without --every"},
    };
    for (const auto& [words, expected] : mistakes) {
        const Result result = typed("reprise " + words, folder_);
        EXPECT_EQ(result.code, 2) << words;
        EXPECT_THAT(result.out, HasSubstr(expected)) << words;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
        EXPECT_EQ(folder_.files(), before) << words;
    }
}

}  // namespace
}  // namespace reprise::test
