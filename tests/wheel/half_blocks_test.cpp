#include "wheel/half_blocks.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace reprise::wheel {
namespace {

constexpr const char* end_of_line = "\x1b[0m\x1b[K\r\n";

/// Rows of one colour each: red, green, blue, white.
Image stripes() {
    Image image{2, 4, {}};
    for (const auto& [r, g, b] : {std::tuple{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}})
        for (int x = 0; x < image.width; ++x)
            for (const int value : {r, g, b})
                image.rgb.push_back(static_cast<std::uint8_t>(value));
    return image;
}

long lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST(HalfBlocks, UpperHalfIsForegroundLowerIsBackground) {
    EXPECT_EQ(half_blocks(stripes(), 2, 2),
              std::string("\x1b[38;2;255;0;0m\x1b[48;2;0;255;0m▀▀") + end_of_line +
                  "\x1b[38;2;0;0;255m\x1b[48;2;255;255;255m▀▀" + end_of_line);
}

TEST(HalfBlocks, SmallerPlacesHoldMeans) {
    EXPECT_EQ(half_blocks(stripes(), 1, 1),
              std::string("\x1b[38;2;127;127;0m\x1b[48;2;127;127;255m▀") + end_of_line);
}

TEST(HalfBlocks, KeepProportionsWithinThePlace) {
    const Image wide{160, 90, std::vector<std::uint8_t>(160UL * 90 * 3, 7)};
    EXPECT_EQ(lines(half_blocks(wide, 80, 100)), 23) << "80 x 45 halves: 22.5 lines";
    EXPECT_EQ(lines(half_blocks(wide, 1000, 10)), 10);
    EXPECT_EQ(half_blocks(wide, 80, 0), "");
    EXPECT_EQ(half_blocks(wide, 0, 24), "");
}

}  // namespace
}  // namespace reprise::wheel
