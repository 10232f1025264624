#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "files/output_file.h"
#include "render/codecs/exr.h"
#include "render/codecs/png.h"
#include "render/palette.h"
#include "world/check.h"

namespace reprise::render {

namespace {

constexpr float nearest = 1;     // [m] white in a viewable depth picture
constexpr float farthest = 200;  // [m] black

std::size_t pixel_count(const world::SensorFrame& frame) {
    return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
}

std::size_t pixel_bytes(const world::SensorFrame& frame) {
    return world::bytes_of(frame.type) * static_cast<std::size_t>(frame.channels);
}

template <typename Value>
Value value_at(const world::SensorFrame& frame, std::size_t index) {
    Value value{};
    std::memcpy(&value, frame.data.data() + index * sizeof(Value), sizeof(Value));
    return value;
}

float depth_at(const world::SensorFrame& frame, std::size_t index) {
    return value_at<float>(frame, index);
}

/// A depth in 16 bits, of so many steps a metre.
std::uint16_t steps(float depth, double a_metre, std::uint16_t beyond) {
    const double whole = std::round(static_cast<double>(depth) * a_metre);
    return whole < 65535 ? static_cast<std::uint16_t>(std::max(whole, 0.0)) : beyond;
}

std::uint16_t coded(float depth, DepthCoding coding) {
    switch (coding) {
        case DepthCoding::kitti:
            return steps(depth, 256, 0);
        case DepthCoding::centimetres:
            return steps(depth, 100, 65535);
        default:
            return steps(depth, 1000, 65535);
    }
}

/// Room for a picture of the frame's size, all 0.
Numbers blank(const world::SensorFrame& frame, int channels, world::PixelType type) {
    Numbers numbers{frame.width, frame.height, channels, type, {}};
    numbers.data.resize(numbers.row_bytes() * static_cast<std::size_t>(frame.height));
    return numbers;
}

template <typename Value>
void put(Numbers& numbers, std::size_t index, Value value) {
    std::memcpy(numbers.data.data() + index * sizeof(Value), &value, sizeof(Value));
}

Numbers carla_depth(const world::SensorFrame& frame) {
    constexpr double steps_a_metre = 16777215.0 / 1000;
    Numbers numbers = blank(frame, 3, world::PixelType::u8);
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const double whole = std::round(
            std::clamp(static_cast<double>(depth_at(frame, i)), 0.0, 1000.0) * steps_a_metre);
        const auto value = static_cast<std::uint32_t>(whole);
        numbers.data[3 * i] = static_cast<std::uint8_t>(value);
        numbers.data[3 * i + 1] = static_cast<std::uint8_t>(value >> 8U);
        numbers.data[3 * i + 2] = static_cast<std::uint8_t>(value >> 16U);
    }
    return numbers;
}

Numbers depth_numbers(const world::SensorFrame& frame, DepthCoding coding) {
    if (coding == DepthCoding::carla)
        return carla_depth(frame);
    Numbers numbers = blank(frame, 1, world::PixelType::u16);
    for (std::size_t i = 0; i < pixel_count(frame); ++i)
        put(numbers, i, coded(depth_at(frame, i), coding));
    return numbers;
}

Numbers flow_numbers(const world::SensorFrame& frame) {
    Numbers numbers = blank(frame, 3, world::PixelType::u16);
    const auto code = [](float pixels) {
        return std::round(64 * static_cast<double>(pixels)) + 32768;
    };
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const double x = code(value_at<float>(frame, 2 * i));
        const double y = code(value_at<float>(frame, 2 * i + 1));
        if (!(x >= 64 && x <= 65472 && y >= 64 && y <= 65472))
            continue;
        put(numbers, 3 * i, static_cast<std::uint16_t>(x));
        put(numbers, 3 * i + 1, static_cast<std::uint16_t>(y));
        put(numbers, 3 * i + 2, std::uint16_t{1});
    }
    return numbers;
}

Eigen::Vector3f normal_at(const world::SensorFrame& frame, std::size_t index) {
    return {value_at<float>(frame, 3 * index),
            value_at<float>(frame, 3 * index + 1),
            value_at<float>(frame, 3 * index + 2)};
}

Numbers normal_numbers(const world::SensorFrame& frame) {
    Numbers numbers = blank(frame, 3, world::PixelType::u16);
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const Eigen::Vector3f normal = normal_at(frame, i);
        if (normal.isZero(0))
            continue;
        for (int axis = 0; axis < 3; ++axis)
            put(numbers,
                3 * i + static_cast<std::size_t>(axis),
                static_cast<std::uint16_t>(std::lround(
                    std::clamp((static_cast<double>(normal[axis]) + 1) * 32767.5, 0.0, 65535.0))));
    }
    return numbers;
}

Numbers numbers_of(const world::SensorFrame& frame, DepthCoding coding) {
    switch (frame.kind) {
        case world::SensorKind::depth:
            return depth_numbers(frame, coding);
        case world::SensorKind::flow:
            return flow_numbers(frame);
        case world::SensorKind::normals:
            return normal_numbers(frame);
        default:
            return {frame.width, frame.height, frame.channels, frame.type, frame.data};
    }
}

/// Around grey: -1 is black, 1 is white.
std::uint8_t signed_grey(float share) {
    return static_cast<std::uint8_t>(std::lround(128 + 127 * std::clamp(share, -1.0F, 1.0F)));
}

/// Neighbouring numbers look different.
Rgb color_of_instance(std::uint16_t number) {
    const std::uint32_t mixed = number * 2654435761U;
    return {static_cast<std::uint8_t>(mixed >> 24U),
            static_cast<std::uint8_t>(mixed >> 16U),
            static_cast<std::uint8_t>(mixed >> 8U)};
}

Rgb color_of_flow(float x, float y) {
    constexpr float full = 32;  // [px]
    if (!std::isfinite(x) || !std::isfinite(y))
        return {0, 0, 0};
    return {signed_grey(x / full), signed_grey(y / full), 128};
}

/// Rising light is blue, falling light red, as CARLA shows them.
Rgb color_of_events(std::uint8_t rising, std::uint8_t falling) {
    return {static_cast<std::uint8_t>(falling > 0 ? 255 : 0),
            0,
            static_cast<std::uint8_t>(rising > 0 ? 255 : 0)};
}

/// Near things bright; equal ratios of distance are equal steps of grey.
std::uint8_t depth_grey(float depth) {
    if (!std::isfinite(depth))
        return 0;
    const float clamped = std::clamp(depth, nearest, farthest);
    const float share = std::log(farthest / clamped) / std::log(farthest / nearest);
    return static_cast<std::uint8_t>(std::lround(255 * share));
}

Rgb color_at(const world::SensorFrame& frame, std::size_t i) {
    switch (frame.kind) {
        case world::SensorKind::depth: {
            const std::uint8_t grey = depth_grey(depth_at(frame, i));
            return {grey, grey, grey};
        }
        case world::SensorKind::instance:
            return color_of_instance(value_at<std::uint16_t>(frame, i));
        case world::SensorKind::flow:
            return color_of_flow(value_at<float>(frame, 2 * i), value_at<float>(frame, 2 * i + 1));
        case world::SensorKind::normals: {
            const Eigen::Vector3f normal = normal_at(frame, i);
            return {signed_grey(normal.x()), signed_grey(normal.y()), signed_grey(normal.z())};
        }
        case world::SensorKind::dvs:
            return color_of_events(frame.data[2 * i], frame.data[2 * i + 1]);
        default:
            return frame.data[i] < cityscapes.size() ? cityscapes[frame.data[i]] : Rgb{};
    }
}

/// Among the grain of an rgb frame zlib finds no strings that are there again, and looks for them
/// half of its time: without, files are 1 % smaller. Flat areas repeat, and the simplest of PNG's
/// filters is enough for them.
PngPacking packing_of(const world::SensorFrame& frame, Texture texture) {
    if (frame.kind == world::SensorKind::semantic)
        return PngPacking::runs;
    return frame.kind == world::SensorKind::rgb && texture == Texture::grainy ? PngPacking::grain
                                                                              : PngPacking::areas;
}

}  // namespace

void write_png(const world::SensorFrame& frame,
               const std::filesystem::path& path,
               Texture texture,
               DepthCoding coding) {
    REPRISE_CHECK(frame.width > 0 && frame.height > 0 &&
                      frame.data.size() == pixel_count(frame) * pixel_bytes(frame),
                  "frame " + frame.name + ": " + std::to_string(frame.data.size()) + " bytes");
    // Packed in memory, so that it is our stream that meets a full disk or a missing folder.
    const std::vector<std::uint8_t> png =
        encode_png(numbers_of(frame, coding), packing_of(frame, texture));
    files::write_file(path, "the picture", png);
}

void write_npy(const world::SensorFrame& frame, const std::filesystem::path& path) {
    const char* type = frame.type == world::PixelType::f32   ? "<f4"
                       : frame.type == world::PixelType::u16 ? "<u2"
                                                             : "|u1";
    std::string header =
        fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}{}), }}",
                    type,
                    frame.height,
                    frame.width,
                    frame.channels > 1 ? fmt::format(", {}", frame.channels) : "");
    // The format's own rule: with its ten bytes before it a multiple of 64.
    header.resize((header.size() + 1 + 10 + 63) / 64 * 64 - 10 - 1, ' ');
    header += '\n';
    std::vector<std::uint8_t> bytes{0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0};
    bytes.push_back(static_cast<std::uint8_t>(header.size()));
    bytes.push_back(static_cast<std::uint8_t>(header.size() >> 8U));
    bytes.insert(bytes.end(), header.begin(), header.end());
    bytes.insert(bytes.end(), frame.data.begin(), frame.data.end());
    files::write_file(path, "the array", bytes);
}

void write_exr(const world::SensorFrame& frame, const std::filesystem::path& path) {
    REPRISE_CHECK(frame.type == world::PixelType::f32, frame.name);
    Numbers numbers{frame.width, frame.height, frame.channels, frame.type, frame.data};
    if (frame.channels == 2) {
        numbers = blank(frame, 3, world::PixelType::f32);
        for (std::size_t i = 0; i < pixel_count(frame); ++i) {
            const float x = value_at<float>(frame, 2 * i);
            const float y = value_at<float>(frame, 2 * i + 1);
            if (!std::isfinite(x) || !std::isfinite(y))
                continue;
            put(numbers, 3 * i, x);
            put(numbers, 3 * i + 1, y);
            put(numbers, 3 * i + 2, 1.0F);
        }
    }
    files::write_file(path, "the picture", encode_exr(numbers));
}

world::SensorFrame in_paper_classes(const world::SensorFrame& frame) {
    world::SensorFrame mapped = frame;
    for (std::uint8_t& value : mapped.data)
        value = value < paper_classes.size() ? paper_classes[value] : std::uint8_t{0};
    return mapped;
}

world::SensorFrame viewable(const world::SensorFrame& frame) {
    if (frame.kind == world::SensorKind::rgb)
        return frame;
    world::SensorFrame picture = frame;
    picture.kind = world::SensorKind::rgb;
    picture.channels = 3;
    picture.type = world::PixelType::u8;
    picture.data.resize(pixel_count(frame) * 3);
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const Rgb color = color_at(frame, i);
        std::copy(
            color.begin(), color.end(), picture.data.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return picture;
}

}  // namespace reprise::render
