#include <algorithm>
#include <cstdlib>
#include <utility>

#include <gmock/gmock.h>

#include "tests/cli/program.h"
#include "world/external/sensor.h"
#include "world/story/wording.h"

namespace reprise::test {
namespace {

/// Two pictures of one short drive.
class Rendering : public testing::Test {
  protected:
    void SetUp() override {
        const Result run = reprise({"run",
                                    source("scenarios/free_drive.lua"),
                                    "-o",
                                    folder_ / "t.mcap",
                                    "--seed",
                                    "7",
                                    "--for",
                                    "4"});
        ASSERT_EQ(run.code, 0) << run.out;
    }

    /// The folder that the pictures are in.
    std::string render(const std::string& camera, const std::string& weather) {
        std::string out = folder_ / (camera + "_" + weather);
        const Result result = reprise({"render",
                                       folder_ / "t.mcap",
                                       "-o",
                                       out,
                                       "--camera",
                                       camera,
                                       "--weather",
                                       weather,
                                       "--size",
                                       "320x240",
                                       "--ticks",
                                       "40..80",
                                       "--every",
                                       "40"});
        EXPECT_EQ(result.code, 0) << result.out;
        return out;
    }

    /// All pictures of a small rendering of all three kinds in hard rain, one after the other.
    std::string pictures(const std::vector<std::string>& more) {
        const Folder out;
        std::vector<std::string> words{"render",
                                       folder_ / "t.mcap",
                                       "-o",
                                       out.path().string(),
                                       "--camera",
                                       "rgb,depth,semantic",
                                       "--weather",
                                       "hard_rain_sunset",
                                       "--size",
                                       "160x120",
                                       "--ticks",
                                       "40..80",
                                       "--every",
                                       "40"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = reprise(words);
        EXPECT_EQ(result.code, 0) << result.out;
        const std::vector<std::string> files = out.files();
        EXPECT_EQ(files.size(), 11U) << "two of rgb, four of the others, the manifest";
        std::string bytes;
        for (const std::string& file : files)
            bytes += file + read_file(out / file);
        return bytes;
    }

    Folder folder_;
};

TEST_F(Rendering, GeometryIsEqualUnderEveryWeatherAndColourIsNot) {
    const std::string trace = read_file(folder_ / "t.mcap");
    for (const std::string camera : {"depth", "semantic", "rgb"}) {
        const std::string clear = render(camera, "clear_noon");
        const std::string rain = render(camera, "hard_rain_sunset");
        for (const std::string picture : {"/000040.png", "/000080.png"}) {
            const std::string one = read_file(clear + picture);
            ASSERT_FALSE(one.empty()) << clear << picture;
            EXPECT_EQ(one == read_file(rain + picture), camera != "rgb") << camera << picture;
        }
    }
    EXPECT_TRUE(trace == read_file(folder_ / "t.mcap")) << "rendering touched the trace";
}

TEST_F(Rendering, TicksAreChosenAsEverywhereAndAsTheyWereBefore) {
    const auto files = [&](const std::vector<std::string>& more, int code = 0) {
        const Folder out;
        std::vector<std::string> words{
            "render", folder_ / "t.mcap", "-o", out.path().string(), "--size", "32x24"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = reprise(words);
        EXPECT_EQ(result.code, code) << result.out;
        return code == 0 ? testing::PrintToString(out.files()) : result.out;
    };
    const std::string some = files({"--ticks", "2s..3s", "--every", "10"});
    EXPECT_THAT(some, testing::HasSubstr("000060.png"));
    EXPECT_EQ(some, files({"--from", "40", "--to", "60", "--every", "10"}));
    EXPECT_EQ(files({"--ticks", "50"}), "{ \"000050.png\", \"manifest.json\" }");
    EXPECT_THAT(files({"--ticks", "40..60", "--to", "60"}, 2),
                testing::HasSubstr("--ticks: says what --from and --to said: without these"));
    EXPECT_THAT(files({"--ticks", "90000.."}, 2), testing::HasSubstr("no such ticks"));
    EXPECT_THAT(reprise({"render", "--help"}).out, testing::Not(testing::HasSubstr("--from")));
}

TEST_F(Rendering, WorksInAnEmptyFolder) {
    const Folder empty;
    std::filesystem::copy(folder_ / "t.mcap", empty / "t.mcap");
    const Result result = reprise(
        {"render", "t.mcap", "-o", "pictures", "--size", "64x48", "--every", "40"}, empty.path());
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(
        empty.files(),
        testing::ElementsAre(
            "pictures/000001.png", "pictures/000041.png", "pictures/manifest.json", "t.mcap"));
}

TEST_F(Rendering, NeitherThreadsNorRepeatsChangeAByte) {
    for (const std::vector<std::string>& mode :
         {std::vector<std::string>{}, std::vector<std::string>{"--portable"}}) {
        const std::string expected = pictures(mode);
        for (const std::string threads : {"1", "2", "4", "4"}) {
            std::vector<std::string> words = mode;
            words.insert(words.end(), {"--threads", threads});
            EXPECT_TRUE(pictures(words) == expected) << threads << " threads";
        }
    }
}

/// What glibc does on a CPU without these features; Embree and our own code ask the CPU itself, so
/// tests/render/portable_pictures_test.sh emulates one.
TEST_F(Rendering, PortablePicturesDoNotAskForTheCpusFeatures) {
    const std::string expected = pictures({"--portable"});
    for (const char* mask : {"-FMA,-FMA4", "-AVX,-AVX2,-FMA,-FMA4,-SSE4_1,-SSE4_2"}) {
        setenv("GLIBC_TUNABLES", (std::string("glibc.cpu.hwcaps=") + mask).c_str(), 1);
        EXPECT_TRUE(pictures({"--portable"}) == expected) << mask;
        unsetenv("GLIBC_TUNABLES");
    }
}

TEST(RenderingMistakes, AreOneClearLineAndMakeNoFolder) {
    const Folder folder;
    const std::string threads = "--threads: expected a number of threads from 1 to 1024, got '";
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes{
        {{"--threads", "0"}, threads + "0'"},
        {{"--threads", "x"}, threads + "x'"},
        {{"--threads", "-2"}, threads + "-2'"},
        {{"--threads", "2.5"}, threads + "2.5'"},
        {{"--threads", ""}, threads + "'"},
        {{"--threads", "99999999999"}, threads + "99999999999'"},
        {{"--camera", "rgb,rgb"}, "--sensor: 'rgb' is there twice"},
        {{"--size", "0x9"}, "--size: expected WIDTHxHEIGHT such as 800x600, got '0x9'"},
        {{"--size", "100000x100000"},
         "--size: 100000x100000 is too large: at most 4096 pixels a side"},
        {{"--size", "4097x100"}, "--size: 4097x100 is too large: at most 4096 pixels a side"},
        {{"--fov", "nan"}, "--fov: expected a number from 1 to 200, got 'nan'"},
        {{"--yaw", "nan"}, "--yaw: expected a number from -360 to 360, got 'nan'"},
        {{"--pitch", "inf"}, "--pitch: expected a number from -360 to 360, got 'inf'"},
        {{"--camera", "depth", "--camera", "rgb,depth"}, "--sensor: 'depth' is there twice"},
    };
    for (const auto& [words, message] : mistakes) {
        std::vector<std::string> all{"render", "t.mcap", "-o", "pictures"};
        all.insert(all.end(), words.begin(), words.end());
        const Result result = reprise(all, folder.path());
        EXPECT_EQ(result.code, 2) << message;
        EXPECT_EQ(result.out, "reprise: " + message + " (reprise --help says more)\n");
        EXPECT_THAT(folder.files(), testing::IsEmpty());
    }
}

TEST_F(Rendering, LabelsAreEqualUnderEveryWeatherAndForEveryNumberOfThreads) {
    for (const std::string sensor : {"instance", "flow", "normals"}) {
        const std::string clear = render(sensor, "clear_noon");
        const std::string rain = render(sensor, "hard_rain_sunset");
        for (const std::string picture : {"/000040.png", "/000080.png"}) {
            const std::string one = read_file(clear + picture);
            ASSERT_FALSE(one.empty()) << clear << picture;
            EXPECT_TRUE(one == read_file(rain + picture)) << sensor << picture;
        }
    }
}

TEST_F(Rendering, ARigFileSaysWhatLooksWhenAndWithWhatBesideIt) {
    write_file(folder_ / "rig.json",
               R"({ "sensors": [
                 { "name": "front", "type": "depth", "size": [32, 24], "rate_hz": 1 },
                 { "name": "mast", "actor": "world", "size": [32, 24], "every": 40 } ] })");
    const Folder out;
    const Result result = reprise({"render",
                                   folder_ / "t.mcap",
                                   "-o",
                                   out.path().string(),
                                   "--rig",
                                   folder_ / "rig.json",
                                   "--ticks",
                                   "10..50",
                                   "--npy",
                                   "--no-view",
                                   "--boxes"});
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(out.files(),
                testing::ElementsAre("front/000020.npy",
                                     "front/000040.npy",
                                     "front/boxes/000020.json",
                                     "front/boxes/000040.json",
                                     "front/calib.txt",
                                     "front/camera.json",
                                     "manifest.json",
                                     "mast/000040.png",
                                     "mast/boxes/000040.json",
                                     "mast/calib.txt",
                                     "mast/camera.json"));
    EXPECT_EQ(read_file(out / "front/000020.npy").size(), 128U + 32 * 24 * 4);
}

TEST_F(Rendering, ARigFilesLidarSeesWhatOneOfTheOptionsSees) {
    write_file(folder_ / "rig.json",
               R"({ "sensors": [
                 { "name": "front", "type": "depth", "size": [32, 24], "every": 20 },
                 { "name": "lidar", "type": "lidar", "position": [1.2, 0, 1.8], "every": 20,
                   "attributes": { "channels": 4, "range": 40 } },
                 { "name": "motion", "type": "imu", "position": [1.2, 0, 1.8] },
                 { "name": "gate", "type": "radar", "actor": "world", "position": [5, 5, 4],
                   "every": 40 } ] })");
    const auto run = [&](const Folder& out, const std::vector<std::string>& more) {
        std::vector<std::string> words{
            "render", folder_ / "t.mcap", "-o", out.path().string(), "--ticks", "20..40"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = reprise(words);
        EXPECT_EQ(result.code, 0) << result.out;
    };
    const Folder rigged;
    run(rigged, {"--rig", folder_ / "rig.json", "--no-view"});
    EXPECT_THAT(rigged.files(),
                testing::ElementsAre("front/000020.png",
                                     "front/000040.png",
                                     "front/calib.txt",
                                     "front/camera.json",
                                     "gate/000040.ply",
                                     "lidar/000020.ply",
                                     "lidar/000040.ply",
                                     "manifest.json",
                                     "motion.csv"));
    const Folder readings;
    run(readings, {"--sensor", "imu", "--mount", "1.2,0,1.8"});
    EXPECT_EQ(read_file(rigged / "motion.csv"), read_file(readings / "imu.csv"));
    const Folder scans;
    run(scans,
        {"--sensor",
         "lidar",
         "--mount",
         "1.2,0,1.8",
         "--attribute",
         "channels=4,range=40",
         "--every",
         "20"});
    const std::string scan = read_file(scans / "000040.ply");
    EXPECT_GT(scan.size(), 1000U);
    EXPECT_TRUE(read_file(rigged / "lidar/000040.ply") == scan);
}

TEST_F(Rendering, OneScanIsSaidToBeOne) {
    const Result result = reprise({"render",
                                   folder_ / "t.mcap",
                                   "-o",
                                   folder_ / "one",
                                   "--sensor",
                                   "lidar",
                                   "--attribute",
                                   "channels=4",
                                   "--ticks",
                                   "20"});
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.out, testing::HasSubstr("one: 1 frame or reading of lidar\n"));
}

TEST_F(Rendering, AFilmOfARigWithoutACameraIsRefused) {
    write_file(folder_ / "rig.json", R"({ "sensors": [ { "name": "roof", "type": "lidar" } ] })");
    const Result film = reprise(
        {"render", folder_ / "t.mcap", "-o", folder_ / "run.mp4", "--rig", folder_ / "rig.json"});
    EXPECT_EQ(film.code, 2);
    EXPECT_THAT(film.out, testing::HasSubstr("a film shows a camera, and there is none in"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run.mp4"));
}

TEST_F(Rendering, AMistakeInARigIsOneLineThatNamesItsPlace) {
    const std::string file = folder_ / "rig.json";
    const auto mistake = [&](const std::string& text) {
        write_file(file, text);
        const Result result =
            reprise({"render", folder_ / "t.mcap", "-o", folder_ / "none", "--rig", file});
        EXPECT_EQ(result.code, 2) << text;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none")) << text;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
        return result.out;
    };
    const auto of_sensor = [&](const std::string& keys) {
        return mistake("{ \"sensors\": [ { \"name\": \"a\", " + keys + " } ] }");
    };
    using testing::HasSubstr;
    EXPECT_THAT(mistake("{ \"sensors\": [\n nan ] }"), HasSubstr("rig.json:2: this is no JSON"));
    EXPECT_THAT(mistake("{ \"sensors\": [ { \"name\": \"a\", \"size\": [8, 8] } ] }\n" +
                        std::string("\0 junk", 6)),
                HasSubstr("rig.json:2: this is no JSON"));
    EXPECT_THAT(mistake("{ \"sensors\": [] }"), HasSubstr("rig.json: expected { \"sensors\": ["));
    EXPECT_THAT(
        mistake("{ \"sensors\":\n [ { \"name\": \"a\", \"actor\": \"[{\\\"],\", \"position\": [0,\n"
                " 1, 2] },\n\n { \"name\": \"b\",\n \"type\": \"deph\" } ] }"),
        HasSubstr("rig.json:5: sensor 2 'b': no type 'deph'"));
    EXPECT_THAT(mistake("{ \"sensors\": [ { \"name\": \"a\" },\n 7 ] }"),
                HasSubstr("rig.json:2: sensor 2: expected { ... }, got 7"));
    EXPECT_THAT(mistake("{ \"sensors\": [ 7 ],\n \"sensors\": [ { \"name\": \"a\" } ] }"),
                HasSubstr("rig.json:2: 'sensors' is there twice"));
    EXPECT_THAT(of_sensor("\"size\": [9, 9],\n \"attributes\": { \"own_car\": 1, \"own_car\": 0 }"),
                HasSubstr("rig.json:2: 'own_car' is there twice"));
    EXPECT_THAT(of_sensor("\"type\": \"deph\""),
                HasSubstr("sensor 1 'a': no type 'deph' (did you mean 'depth'?); there are rgb"));
    EXPECT_THAT(of_sensor("\"size\": [100000, 100000]"),
                HasSubstr("'size' must be a number in [1, 4096], got 100000"));
    EXPECT_THAT(of_sensor("\"size\": [0, 10]"), HasSubstr("'size' must be a number in [1, 4096]"));
    EXPECT_THAT(of_sensor("\"fov_deg\": 0"), HasSubstr("'fov_deg' must be a number in [1, 200]"));
    EXPECT_THAT(of_sensor("\n\"yaw_deg\": 1e999\n"),
                HasSubstr("rig.json:2: a number is too large"));
    EXPECT_THAT(of_sensor("\"postion\": [1, 2, 3]"), HasSubstr("(did you mean 'position'?)"));
    EXPECT_THAT(of_sensor("\"attributes\": { \"fov\": 60 }"),
                HasSubstr("'fov' (did you mean 'fov_deg', beside 'attributes'?)"));
    EXPECT_THAT(of_sensor("\"actor\": \"\""), HasSubstr("sensor 1 'a': 'actor' is empty; without"));
    EXPECT_THAT(
        of_sensor("\n\"actor\": \"ega\""),
        testing::ContainsRegex("rig.json:1: sensor 1 'a': .*t.mcap: no actor 'ega' .did you"));
    EXPECT_THAT(
        of_sensor("\"position\": [" + std::string(5000, '[') + std::string(5000, ']') + "]"),
        testing::EndsWith("[[[[[[...\n"));
    EXPECT_THAT(of_sensor("\"rate_hz\": 3"), HasSubstr("20 over a whole number"));
    EXPECT_THAT(of_sensor("\"type\": \"lidar\", \"size\": [64, 64]"),
                HasSubstr("'size' is of cameras; what a lidar measures, its 'attributes' say"));
    EXPECT_THAT(of_sensor("\"type\": \"imu\", \"size\": [64, 64]"),
                HasSubstr("; what an imu measures, its"));
    EXPECT_THAT(of_sensor("\"type\": \"collision\", \"actor\": \"world\""),
                HasSubstr("a collision tells what its 'actor' does, who cannot be the world"));
    EXPECT_THAT(of_sensor("\"attributes\": { \"own_cat\": 1 }"),
                HasSubstr("(did you mean 'own_car'?)"));
    EXPECT_THAT(
        reprise({"render", folder_ / "t.mcap", "-o", folder_ / "none", "--rig", "no.json"}).out,
        HasSubstr("no.json: cannot be read"));
    EXPECT_THAT(
        reprise({"render", folder_ / "t.mcap", "-o", folder_ / "none", "--sensor", "instnce"}).out,
        HasSubstr("did you mean 'instance'"));
}

TEST_F(Rendering, TicksInWhichNoCameraOfARigLooksAreNamed) {
    const std::string file = folder_ / "rig.json";
    write_file(file, R"({ "sensors": [ { "name": "a", "every": 39, "size": [9, 9] } ] })");
    const auto refusal = [&](const std::string& ticks) {
        const Result result = reprise({"render",
                                       folder_ / "t.mcap",
                                       "-o",
                                       folder_ / "none",
                                       "--rig",
                                       file,
                                       "--ticks",
                                       ticks});
        EXPECT_EQ(result.code, 2) << ticks;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none")) << ticks;
        return result.out;
    };
    using testing::HasSubstr;
    EXPECT_THAT(refusal("30..33"),
                HasSubstr("no camera of the rig looks in ticks 30 to 33; the next one does in tick "
                          "39;"));
    EXPECT_THAT(refusal("79..79"),
                HasSubstr("no camera of the rig looks in ticks 79 to 79; --every"));
}

TEST_F(Rendering, AMountIsAtMostAsFarAwayAsThatOfARigFile) {
    for (const std::string mount : {"50.1,0,1", "0,-1e300,1", "0,0,51"}) {
        const Result result =
            reprise({"render", folder_ / "t.mcap", "-o", folder_ / "none", "--mount=" + mount});
        EXPECT_EQ(result.code, 2) << mount;
        EXPECT_THAT(
            result.out,
            testing::HasSubstr("--mount: expected at most 50 m along each axis, got '" + mount));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none")) << mount;
    }
    const Folder pictures;
    EXPECT_EQ(reprise({"render",
                       folder_ / "t.mcap",
                       "-o",
                       pictures.path().string(),
                       "--mount=-50,0,50",
                       "--size=32x24",
                       "--ticks=40"})
                  .code,
              0);
}

TEST_F(Rendering, WhatAKindOfSensorDoesNotHaveIsRefusedInARigFileAndAmongOptions) {
    const auto refused = [&](std::vector<std::string> words, const std::string& why) {
        words.insert(words.begin(), {"render", folder_ / "t.mcap", "-o", folder_ / "none"});
        const Result result = reprise(words);
        EXPECT_EQ(result.code, 2) << why;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
        EXPECT_THAT(result.out, testing::HasSubstr(why));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none")) << why;
    };
    const std::string file = folder_ / "rig.json";
    const auto refused_in_file =
        [&](const std::string& kind, const std::string& keys, const std::string& why) {
            write_file(file,
                       "{ \"sensors\": [ { \"name\": \"a\", \"type\": \"" + kind + "\", " + keys +
                           " } ] }");
            refused({"--rig", file}, "rig.json:1: sensor 1 'a': " + why);
        };
    for (const std::string& kind : world::sensor_kinds()) {
        if (world::is_camera(*world::find_sensor_kind(kind))) {
            refused_in_file(
                kind, R"("attributes": { "channels": 3 })", "'attributes': unknown key 'channels'");
            continue;
        }
        const std::string is_of_cameras =
            " is of cameras; what " + world::with_article(kind) + " measures, its 'attributes' say";
        refused_in_file(kind, R"("size": [5, 5])", "'size'" + is_of_cameras);
        refused_in_file(kind, R"("fov_deg": 5)", "'fov_deg'" + is_of_cameras);
        refused_in_file(
            kind, R"("attributes": { "own_car": 1 })", "'attributes': unknown key 'own_car'");
        for (const std::string option : {"--size=5x5",
                                         "--fov=5",
                                         "--own-car",
                                         "--preset=chase",
                                         "--overlay",
                                         "--boxes",
                                         "--calibration",
                                         "--depth-coding=mm",
                                         "--classes=paper",
                                         "--events=csv",
                                         "--npy",
                                         "--exr"})
            refused({"--sensor", kind, option},
                    option.substr(0, option.find('=')) + ": is of cameras, and of --sensor " +
                        kind + " none is one");
        refused({"--sensor", kind, "--attribute", "own_car=1"},
                "--attribute: none of these sensors has an attribute 'own_car'");
    }
}

TEST_F(Rendering, AFormatOfWhatIsNotMadeIsRefused) {
    const std::string file = folder_ / "rig.json";
    write_file(file, R"({ "sensors": [ { "name": "a" }, { "name": "b", "type": "gnss" } ] })");
    for (const auto& looks : {std::vector<std::string>{"--rig", file}, {"--sensor", "rgb,gnss"}})
        for (const std::string option : {"--npy",
                                         "--exr",
                                         "--events=npy",
                                         "--depth-coding=cm",
                                         "--classes=carla",
                                         "--points=ply"}) {
            std::vector<std::string> words{
                "render", folder_ / "t.mcap", "-o", folder_ / "none", option};
            words.insert(words.end(), looks.begin(), looks.end());
            const Result result = reprise(words);
            EXPECT_EQ(result.code, 2) << option;
            EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
            EXPECT_THAT(result.out, testing::HasSubstr("and none is made here"));
            EXPECT_THAT(result.out, testing::HasSubstr(option.substr(0, option.find('='))));
            EXPECT_FALSE(std::filesystem::exists(folder_ / "none")) << option;
        }
}

TEST_F(Rendering, WhatWasRecordedIsChangedByNumbersBehindIt) {
    const auto picture = [&](const std::string& weather) {
        const Folder pictures;
        const Result result = reprise({"render",
                                       folder_ / "t.mcap",
                                       "-o",
                                       pictures.path().string(),
                                       "--size=32x24",
                                       "--ticks=40",
                                       "--weather",
                                       weather});
        EXPECT_EQ(result.code, 0) << result.out;
        return read_file(pictures / "000040.png");
    };
    const std::string foggy = picture("recorded,fog=50");
    EXPECT_EQ(foggy, picture("clear_noon,fog=50")) << "under clear noon it was recorded";
    EXPECT_NE(foggy, picture("recorded"));
    for (const std::string weather :
         {"recorded,", "recorded,clear_noon", "0s:recorded,1s:rain=5"}) {
        const Result result =
            reprise({"render", folder_ / "t.mcap", "-o", folder_ / "none", "--weather", weather});
        EXPECT_EQ(result.code, 2) << weather;
        EXPECT_THAT(result.out, testing::ContainsRegex("behind recorded|stands alone"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none")) << weather;
    }
}

}  // namespace
}  // namespace reprise::test
