#include <gmock/gmock.h>

#include "tests/cli/program.h"

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
        const std::string out = folder_ / (camera + "_" + weather);
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
                                       "--from",
                                       "40",
                                       "--to",
                                       "80",
                                       "--every",
                                       "40"});
        EXPECT_EQ(result.code, 0) << result.out;
        return out;
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

TEST_F(Rendering, WorksInAnEmptyFolder) {
    const Folder empty;
    std::filesystem::copy(folder_ / "t.mcap", empty / "t.mcap");
    const Result result = reprise(
        {"render", "t.mcap", "-o", "pictures", "--size", "64x48", "--every", "40"}, empty.path());
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(empty.files(),
                testing::ElementsAre("pictures/000001.png", "pictures/000041.png", "t.mcap"));
}

}  // namespace
}  // namespace reprise::test
