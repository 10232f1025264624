#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "render/codecs/exr.h"
#include "render/codecs/png.h"

namespace reprise::render {
namespace {

/// Numbers of every byte, the same each time.
Numbers mixed(int channels, world::PixelType type) {
    Numbers numbers{37, 23, channels, type, {}};
    numbers.data.resize(numbers.row_bytes() * 23);
    std::uint32_t state = 1;
    for (std::uint8_t& byte : numbers.data)
        byte = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24U);
    return numbers;
}

Numbers depths() {
    Numbers numbers = mixed(1, world::PixelType::f32);
    for (std::size_t i = 0; i < numbers.data.size() / sizeof(float); ++i) {
        const float depth =
            i == 7 ? std::numeric_limits<float>::infinity() : 0.37F * static_cast<float>(i);
        std::memcpy(numbers.data.data() + i * sizeof(float), &depth, sizeof depth);
    }
    return numbers;
}

void expect_equal(const Numbers& found, const Numbers& expected) {
    EXPECT_EQ(found.width, expected.width);
    EXPECT_EQ(found.height, expected.height);
    EXPECT_EQ(found.channels, expected.channels);
    EXPECT_EQ(found.type, expected.type);
    EXPECT_EQ(found.data, expected.data);
}

TEST(Png, GivesBackWhatWasPackedInEveryWay) {
    for (const int channels : {1, 3})
        for (const auto type : {world::PixelType::u8, world::PixelType::u16})
            for (const auto packing : {PngPacking::grain, PngPacking::runs, PngPacking::areas}) {
                const Numbers numbers = mixed(channels, type);
                const auto back = decode_png(encode_png(numbers, packing));
                ASSERT_TRUE(back);
                expect_equal(*back, numbers);
            }
}

TEST(Png, IsWhatOpenCVPacks) {
    const Numbers numbers = mixed(1, world::PixelType::u16);
    const cv::Mat matrix(
        numbers.height, numbers.width, CV_16UC1, const_cast<std::uint8_t*>(numbers.data.data()));
    std::vector<std::uint8_t> expected;
    cv::imencode(
        ".png", matrix, expected, {cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_DEFAULT});
    EXPECT_EQ(encode_png(numbers, PngPacking::areas), expected);
}

TEST(Exr, GivesBackWhatWasPacked) {
    const auto back = decode_exr(encode_exr(depths()));
    ASSERT_TRUE(back);
    expect_equal(*back, depths());
}

/// Any beginning of a file, and any file with a byte changed: read as a picture or not at all.
template <typename Decode>
void expect_no_harm(std::vector<std::uint8_t> file, Decode decode) {
    for (std::size_t size = 0; size < file.size(); size += 1 + size / 16)
        EXPECT_FALSE(decode(std::span(file).first(size))) << size << " of " << file.size();
    int read = 0;
    for (std::size_t at = 0; at < file.size(); at += 1 + at / 64) {
        file[at] ^= 0x55U;
        if (const auto numbers = decode(file)) {
            ++read;
            EXPECT_EQ(numbers->data.size(),
                      numbers->row_bytes() * static_cast<std::size_t>(numbers->height));
        }
        file[at] ^= 0x55U;
    }
    EXPECT_TRUE(decode(file)) << "whole again; " << read << " broken ones could be read";
}

TEST(Png, OfBrokenBytesIsNoPicture) {
    expect_no_harm(encode_png(mixed(3, world::PixelType::u8), PngPacking::grain),
                   [](std::span<const std::uint8_t> bytes) { return decode_png(bytes); });
}

TEST(Exr, OfBrokenBytesIsNoPicture) {
    expect_no_harm(encode_exr(depths()),
                   [](std::span<const std::uint8_t> bytes) { return decode_exr(bytes); });
}

TEST(Png, ThatSaysItIsHugeIsNotRead) {
    auto file = encode_png(mixed(1, world::PixelType::u8), PngPacking::areas);
    const std::vector<std::uint8_t> side{0, 0, 0x7F, 0xFF};
    std::copy(side.begin(), side.end(), file.begin() + 16);
    std::copy(side.begin(), side.end(), file.begin() + 20);
    EXPECT_FALSE(decode_png(file));
}

}  // namespace
}  // namespace reprise::render
