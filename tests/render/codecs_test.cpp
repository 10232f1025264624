#include <array>
#include <bit>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <png.h>
#include <zlib.h>

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

/// What libpng itself makes of it, with the filters that it chooses and Huffman's codes alone.
std::vector<std::uint8_t> grain_of_libpng(const Numbers& numbers) {
    std::vector<std::uint8_t> file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png,
        &file,
        [](png_structp to, png_bytep bytes, png_size_t size) {
            auto& all = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(to));
            all.insert(all.end(), bytes, bytes + size);
        },
        nullptr);
    png_set_compression_level(png, Z_BEST_SPEED);
    png_set_compression_strategy(png, Z_HUFFMAN_ONLY);
    png_set_IHDR(png,
                 info,
                 static_cast<png_uint_32>(numbers.width),
                 static_cast<png_uint_32>(numbers.height),
                 8,
                 numbers.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < numbers.height; ++y)
        png_write_row(png, numbers.data.data() + static_cast<std::size_t>(y) * numbers.row_bytes());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

TEST(Png, OfGrainIsWhatLibpngPacks) {
    constexpr std::array<std::array<int, 2>, 10> sizes{{{1, 1},
                                                        {1, 9},
                                                        {9, 1},
                                                        {2, 2},
                                                        {17, 5},
                                                        {60, 3},
                                                        {127, 129},
                                                        {84, 84},
                                                        {200, 88},
                                                        {320, 240}}};
    std::uint32_t state = 1;
    const auto draw = [&] { return (state = state * 1664525 + 1013904223) >> 8U; };
    for (const auto& [width, height] : sizes)
        for (const int channels : {1, 3})
            for (int kind = 0; kind < 6; ++kind) {
                Numbers numbers{width, height, channels, world::PixelType::u8, {}};
                for (int i = 0; i < width * height * channels; ++i) {
                    const auto slope = static_cast<std::uint32_t>(i / channels % width + i / width);
                    const std::uint32_t rare = std::countr_zero(draw() | 1U << 20U) * 9U;
                    const std::array<std::uint32_t, 6> values{
                        7, draw(), slope, slope / 3 + draw() % 5, rare, rare * rare};
                    numbers.data.push_back(
                        static_cast<std::uint8_t>(values[static_cast<std::size_t>(kind)]));
                }
                EXPECT_TRUE(encode_png(numbers, PngPacking::grain) == grain_of_libpng(numbers))
                    << width << "x" << height << ", " << channels << " channels, kind " << kind;
            }
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
