#include "render/picture.h"

#include <fstream>
#include <limits>
#include <unistd.h>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "render/palette.h"
#include "tests/render/frames.h"
#include "world/check.h"

namespace reprise {

namespace {

class Picture : public testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            std::filesystem::path(testing::TempDir()) / ("picture_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }

    void TearDown() override { std::filesystem::remove_all(folder_); }

    cv::Mat written(const world::SensorFrame& frame) {
        render::write_png(frame, folder_ / "frame.png");
        return cv::imread((folder_ / "frame.png").string(), cv::IMREAD_UNCHANGED);
    }

    std::filesystem::path folder_;
};

world::SensorFrame frame_of(world::SensorKind kind, world::PixelType type, int channels) {
    world::SensorFrame frame;
    frame.kind = kind;
    frame.type = type;
    frame.channels = channels;
    frame.width = 5;
    frame.height = 3;
    return frame;
}

world::SensorFrame depths(const std::vector<float>& values) {
    world::SensorFrame frame = frame_of(world::SensorKind::depth, world::PixelType::f32, 1);
    frame.data.resize(15 * sizeof(float));
    std::memcpy(frame.data.data(), values.data(), frame.data.size());
    return frame;
}

}  // namespace

TEST_F(Picture, ColoursComeBackFromPng) {
    world::SensorFrame frame = frame_of(world::SensorKind::rgb, world::PixelType::u8, 3);
    for (int i = 0; i < 45; ++i)
        frame.data.push_back(static_cast<std::uint8_t>(i * 5));
    const cv::Mat read = written(frame);
    ASSERT_EQ(read.type(), CV_8UC3);
    ASSERT_EQ(read.size(), cv::Size(5, 3));
    for (std::size_t i = 0; i < 45; i += 3) {
        const std::uint8_t* blue_first = read.ptr<std::uint8_t>() + i;
        EXPECT_EQ(blue_first[2], frame.data[i]);
        EXPECT_EQ(blue_first[1], frame.data[i + 1]);
        EXPECT_EQ(blue_first[0], frame.data[i + 2]);
    }
}

TEST_F(Picture, DepthIsWrittenInMillimetres) {
    std::vector<float> values(15, 12.3456F);
    values[1] = 65.5344F;
    values[2] = 65.6F;
    values[3] = std::numeric_limits<float>::infinity();
    const cv::Mat read = written(depths(values));
    ASSERT_EQ(read.type(), CV_16UC1);
    EXPECT_EQ(read.at<std::uint16_t>(0, 0), 12346);
    EXPECT_EQ(read.at<std::uint16_t>(0, 1), 65534);
    EXPECT_EQ(read.at<std::uint16_t>(0, 2), 65535);
    EXPECT_EQ(read.at<std::uint16_t>(0, 3), 65535);
}

TEST_F(Picture, ClassesAreWrittenAsTheyAre) {
    world::SensorFrame frame = frame_of(world::SensorKind::semantic, world::PixelType::u8, 1);
    frame.data = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 24};
    const cv::Mat read = written(frame);
    ASSERT_EQ(read.type(), CV_8UC1);
    EXPECT_TRUE(std::equal(frame.data.begin(), frame.data.end(), read.ptr<std::uint8_t>()));
}

TEST_F(Picture, MissingFolderIsTheUsersMistakeAndLeavesNothing) {
    const world::SensorFrame frame = depths(std::vector<float>(15, 1));
    EXPECT_THROW(render::write_png(frame, folder_ / "none" / "a.png"), world::Error);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
}

TEST_F(Picture, FullDiskIsReported) {
    if (!std::filesystem::exists("/dev/full"))
        GTEST_SKIP();
    EXPECT_THROW(render::write_png(depths(std::vector<float>(15, 1)), "/dev/full"), world::Error);
}

TEST(Viewable, PaintsClassesInTheirColours) {
    world::SensorFrame frame = frame_of(world::SensorKind::semantic, world::PixelType::u8, 1);
    frame.data.assign(15, static_cast<std::uint8_t>(world::SemanticClass::car));
    frame.data[1] = static_cast<std::uint8_t>(world::SemanticClass::road_line);
    const world::SensorFrame picture = render::viewable(frame);
    EXPECT_EQ(picture.channels, 3);
    EXPECT_THAT(std::vector(picture.data.begin(), picture.data.begin() + 6),
                testing::ElementsAre(0, 0, 142, 157, 234, 50));
}

TEST(Viewable, ShowsNearThingsBright) {
    std::vector<float> values(15, 1);
    values[1] = 10;
    values[2] = 100;
    values[3] = std::numeric_limits<float>::infinity();
    const world::SensorFrame picture = render::viewable(depths(values));
    EXPECT_EQ(picture.data[0], 255);
    EXPECT_GT(picture.data[3], picture.data[6]);
    EXPECT_GT(picture.data[6], picture.data[9]);
    EXPECT_EQ(picture.data[9], 0);
}

}  // namespace reprise
