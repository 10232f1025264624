#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "files/output_file.h"
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

cv::Mat carla_depth(const world::SensorFrame& frame) {
    constexpr double steps_a_metre = 16777215.0 / 1000;
    cv::Mat matrix(frame.height, frame.width, CV_8UC3);
    std::uint8_t* target = matrix.ptr<std::uint8_t>();
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const double whole = std::round(
            std::clamp(static_cast<double>(depth_at(frame, i)), 0.0, 1000.0) * steps_a_metre);
        const auto value = static_cast<std::uint32_t>(whole);
        // OpenCV keeps blue first.
        target[3 * i] = static_cast<std::uint8_t>(value >> 16U);
        target[3 * i + 1] = static_cast<std::uint8_t>(value >> 8U);
        target[3 * i + 2] = static_cast<std::uint8_t>(value);
    }
    return matrix;
}

cv::Mat depth_matrix(const world::SensorFrame& frame, DepthCoding coding) {
    if (coding == DepthCoding::carla)
        return carla_depth(frame);
    cv::Mat matrix(frame.height, frame.width, CV_16UC1);
    for (std::size_t i = 0; i < pixel_count(frame); ++i)
        matrix.ptr<std::uint16_t>()[i] = coded(depth_at(frame, i), coding);
    return matrix;
}

cv::Mat flow_matrix(const world::SensorFrame& frame) {
    cv::Mat matrix(frame.height, frame.width, CV_16UC3, cv::Scalar::all(0));
    const auto code = [](float pixels) {
        return std::round(64 * static_cast<double>(pixels)) + 32768;
    };
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const double x = code(value_at<float>(frame, 2 * i));
        const double y = code(value_at<float>(frame, 2 * i + 1));
        if (!(x >= 64 && x <= 65472 && y >= 64 && y <= 65472))
            continue;
        std::uint16_t* target = matrix.ptr<std::uint16_t>() + 3 * i;
        target[0] = 1;
        target[1] = static_cast<std::uint16_t>(y);
        target[2] = static_cast<std::uint16_t>(x);
    }
    return matrix;
}

Eigen::Vector3f normal_at(const world::SensorFrame& frame, std::size_t index) {
    return {value_at<float>(frame, 3 * index),
            value_at<float>(frame, 3 * index + 1),
            value_at<float>(frame, 3 * index + 2)};
}

cv::Mat normal_matrix(const world::SensorFrame& frame) {
    cv::Mat matrix(frame.height, frame.width, CV_16UC3, cv::Scalar::all(0));
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        const Eigen::Vector3f normal = normal_at(frame, i);
        if (normal.isZero(0))
            continue;
        for (int axis = 0; axis < 3; ++axis)
            matrix.ptr<std::uint16_t>()[3 * i + 2 - static_cast<std::size_t>(axis)] =
                static_cast<std::uint16_t>(std::lround(
                    std::clamp((static_cast<double>(normal[axis]) + 1) * 32767.5, 0.0, 65535.0)));
    }
    return matrix;
}

cv::Mat matrix_of(const world::SensorFrame& frame, DepthCoding coding) {
    switch (frame.kind) {
        case world::SensorKind::depth:
            return depth_matrix(frame, coding);
        case world::SensorKind::flow:
            return flow_matrix(frame);
        case world::SensorKind::normals:
            return normal_matrix(frame);
        default:
            break;
    }
    cv::Mat matrix;
    if (frame.channels == 1) {
        const bool wide = frame.type == world::PixelType::u16;
        matrix.create(frame.height, frame.width, wide ? CV_16UC1 : CV_8UC1);
        std::copy(frame.data.begin(), frame.data.end(), matrix.ptr<std::uint8_t>());
        return matrix;
    }
    // OpenCV keeps blue first.
    matrix.create(frame.height, frame.width, CV_8UC3);
    std::uint8_t* target = matrix.ptr<std::uint8_t>();
    for (std::size_t i = 0; i < frame.data.size(); i += 3) {
        target[i] = frame.data[i + 2];
        target[i + 1] = frame.data[i + 1];
        target[i + 2] = frame.data[i];
    }
    return matrix;
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
/// filters, which OpenCV takes where no level is asked for, is enough for them.
std::vector<int> packing_of(const world::SensorFrame& frame, Texture texture) {
    if (frame.kind == world::SensorKind::semantic)
        return {cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE};
    if (frame.kind != world::SensorKind::rgb || texture == Texture::flat)
        return {cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_DEFAULT};
    return {cv::IMWRITE_PNG_COMPRESSION,
            1,
            cv::IMWRITE_PNG_STRATEGY,
            cv::IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY};
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
    std::vector<std::uint8_t> png;
    const bool packed =
        cv::imencode(".png", matrix_of(frame, coding), png, packing_of(frame, texture));
    REPRISE_CHECK(packed, "OpenCV: " + path.string());
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
    const int channels = frame.channels == 1 ? 1 : 3;
    cv::Mat matrix(frame.height, frame.width, channels == 1 ? CV_32FC1 : CV_32FC3);
    // OpenCV keeps blue first.
    for (std::size_t i = 0; i < pixel_count(frame); ++i) {
        float* pixel = matrix.ptr<float>() + i * static_cast<std::size_t>(channels);
        if (channels == 1) {
            pixel[0] = depth_at(frame, i);
        } else if (frame.channels == 3) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                pixel[2 - axis] = value_at<float>(frame, 3 * i + axis);
        } else {
            const float x = value_at<float>(frame, 2 * i);
            const float y = value_at<float>(frame, 2 * i + 1);
            const bool known = std::isfinite(x) && std::isfinite(y);
            pixel[0] = known ? 1.0F : 0.0F;
            pixel[1] = known ? y : 0.0F;
            pixel[2] = known ? x : 0.0F;
        }
    }
    // Off unless one asks for it: Debian's OpenCV has it nevertheless.
    static const bool asked = setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1) == 0;
    std::vector<std::uint8_t> exr;
    const std::vector<int> packing{cv::IMWRITE_EXR_TYPE,
                                   cv::IMWRITE_EXR_TYPE_FLOAT,
                                   cv::IMWRITE_EXR_COMPRESSION,
                                   cv::IMWRITE_EXR_COMPRESSION_ZIP};
    REPRISE_CHECK(asked && cv::imencode(".exr", matrix, exr, packing), "OpenCV: " + path.string());
    files::write_file(path, "the picture", exr);
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
