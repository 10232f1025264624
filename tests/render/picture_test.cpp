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

TEST_F(Picture, DepthIsWrittenInMillimetresWhereThatIsAskedFor) {
    std::vector<float> values(15, 12.3456F);
    values[1] = 65.5344F;
    values[2] = 65.6F;
    values[3] = std::numeric_limits<float>::infinity();
    render::write_png(depths(values),
                      folder_ / "frame.png",
                      render::Texture::grainy,
                      render::DepthCoding::millimetres);
    const cv::Mat read = cv::imread((folder_ / "frame.png").string(), cv::IMREAD_UNCHANGED);
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

TEST_F(Picture, DepthsComeBackFromEveryCoding) {
    const std::vector<float> metres{0.5F,
                                    1,
                                    2.5F,
                                    10,
                                    65,
                                    66,
                                    250,
                                    255,
                                    300,
                                    600,
                                    700,
                                    999,
                                    1000,
                                    1001,
                                    std::numeric_limits<float>::infinity()};
    const world::SensorFrame frame = depths(metres);
    const auto read = [&](render::DepthCoding coding) {
        render::write_png(frame, folder_ / "frame.png", render::Texture::grainy, coding);
        return cv::imread((folder_ / "frame.png").string(), cv::IMREAD_UNCHANGED);
    };
    const cv::Mat centimetres = read(render::DepthCoding::centimetres);
    const cv::Mat kitti = read(render::DepthCoding::kitti);
    const cv::Mat carla = read(render::DepthCoding::carla);
    ASSERT_EQ(carla.type(), CV_8UC3);
    for (int i = 0; i < 15; ++i) {
        const auto depth = static_cast<double>(metres[static_cast<std::size_t>(i)]);
        const int in_centimetres = centimetres.ptr<std::uint16_t>()[i];
        if (depth < 655)
            EXPECT_NEAR(in_centimetres / 100.0, depth, 0.0051);
        else
            EXPECT_EQ(in_centimetres, 65535);
        const int in_kitti = kitti.ptr<std::uint16_t>()[i];
        if (depth < 256)
            EXPECT_NEAR(in_kitti / 256.0, depth, 0.5 / 256);
        else
            EXPECT_EQ(in_kitti, 0) << "not measured";
        // As CARLA's documentation says; OpenCV reads blue first.
        const std::uint8_t* bgr = carla.ptr<std::uint8_t>() + 3 * i;
        const double decoded = 1000.0 * (bgr[2] + 256.0 * bgr[1] + 65536.0 * bgr[0]) / 16777215.0;
        EXPECT_NEAR(decoded, std::min(depth, 1000.0), 6e-5);
    }
}

TEST_F(Picture, FlowAndNormalsComeBackFromPng) {
    world::SensorFrame flow = frame_of(world::SensorKind::flow, world::PixelType::f32, 2);
    std::vector<float> motions(30, 0);
    motions[0] = 12.5F;
    motions[1] = -3.25F;
    motions[2] = motions[3] = std::numeric_limits<float>::quiet_NaN();
    flow.data.resize(30 * sizeof(float));
    std::memcpy(flow.data.data(), motions.data(), flow.data.size());
    const cv::Mat read = written(flow);
    ASSERT_EQ(read.type(), CV_16UC3);
    const std::uint16_t* bgr = read.ptr<std::uint16_t>();
    EXPECT_EQ((bgr[2] - 32768) / 64.0, 12.5);
    EXPECT_EQ((bgr[1] - 32768) / 64.0, -3.25);
    EXPECT_EQ(bgr[0], 1);
    EXPECT_EQ(bgr[3] + bgr[4] + bgr[5], 0) << "unknown";

    world::SensorFrame normals = frame_of(world::SensorKind::normals, world::PixelType::f32, 3);
    std::vector<float> vectors(45, 0);
    vectors[1] = -1;
    normals.data.resize(45 * sizeof(float));
    std::memcpy(normals.data.data(), vectors.data(), normals.data.size());
    const cv::Mat of_normals = written(normals);
    EXPECT_EQ(of_normals.ptr<std::uint16_t>()[1], 0);
    EXPECT_NEAR(of_normals.ptr<std::uint16_t>()[2], 32767.5, 1);
    EXPECT_EQ(of_normals.ptr<std::uint16_t>()[5], 0) << "the sky has none";
}

TEST_F(Picture, ArraysHoldWhatTheFrameHolds) {
    const world::SensorFrame frame = depths(std::vector<float>(15, 700.125F));
    render::write_npy(frame, folder_ / "frame.npy");
    std::ifstream file(folder_ / "frame.npy", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    ASSERT_EQ(bytes.size() % 64, frame.data.size() % 64) << "numbers begin at a multiple of 64";
    EXPECT_EQ(bytes.substr(0, 6), "\x93NUMPY");
    EXPECT_THAT(bytes, testing::HasSubstr("'shape': (3, 5)"));
    EXPECT_EQ(bytes.substr(bytes.size() - frame.data.size()),
              std::string(frame.data.begin(), frame.data.end()));
}

}  // namespace reprise
