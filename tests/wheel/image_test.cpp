#include "wheel/image.h"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace reprise::wheel {
namespace {

Image image_of_bytes(world::SensorKind kind, int width, const std::vector<std::uint8_t>& bytes) {
    world::SensorSpec sensor;
    sensor.kind = kind;
    sensor.width = width;
    sensor.height = 1;
    return image_of({&sensor, bytes});
}

TEST(ImageOf, ColoursStay) {
    const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6};
    const Image image = image_of_bytes(world::SensorKind::rgb, 2, bytes);
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(image.rgb, bytes);
}

TEST(ImageOf, EachClassHasAColour) {
    std::vector<std::uint8_t> classes;
    for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(world::SemanticClass::ground); ++i)
        if (i != 17 && i != 22)  // CARLA's tags that nothing here has
            classes.push_back(i);
    const auto count = classes.size();
    const Image image =
        image_of_bytes(world::SensorKind::semantic, static_cast<int>(count), classes);
    ASSERT_EQ(image.rgb.size(), 3 * count);
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_FALSE(image.rgb[3 * i] == 255 && image.rgb[3 * i + 1] == 0) << int{classes[i]};
    EXPECT_EQ(image_of_bytes(world::SensorKind::semantic, 1, {200}).rgb,
              (std::vector<std::uint8_t>{255, 0, 255}))
        << "what is none of them is told";
}

TEST(ImageOf, DepthIsGrayFromBlackToWhite) {
    const std::vector<float> depths{
        0.5F, 10.0F, 100.0F, 5000.0F, std::numeric_limits<float>::infinity()};
    std::vector<std::uint8_t> bytes(depths.size() * sizeof(float));
    std::memcpy(bytes.data(), depths.data(), bytes.size());
    const Image image = image_of_bytes(world::SensorKind::depth, 5, bytes);
    const std::vector<std::uint8_t> gray{0, 85, 170, 255, 255};  // a third of it a decade
    for (std::size_t i = 0; i < gray.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(image.rgb[3 * i + channel], gray[i], 1) << depths[i];
}

}  // namespace
}  // namespace reprise::wheel
