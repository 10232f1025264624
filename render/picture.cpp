#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

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

float depth_at(const world::SensorFrame& frame, std::size_t index) {
    float depth = 0;
    std::memcpy(&depth, frame.data.data() + index * sizeof(float), sizeof(float));
    return depth;
}

/// Millimetres in 16 bits; what does not fit, and the sky, is 65535.
std::uint16_t millimetres(float depth) {
    const double whole = std::round(static_cast<double>(depth) * 1000);
    return whole < 65535 ? static_cast<std::uint16_t>(std::max(whole, 0.0)) : std::uint16_t{65535};
}

cv::Mat matrix_of(const world::SensorFrame& frame) {
    cv::Mat matrix;
    if (frame.type == world::PixelType::f32) {
        matrix.create(frame.height, frame.width, CV_16UC1);
        for (std::size_t i = 0; i < pixel_count(frame); ++i)
            matrix.ptr<std::uint16_t>()[i] = millimetres(depth_at(frame, i));
        return matrix;
    }
    if (frame.channels == 1) {
        matrix.create(frame.height, frame.width, CV_8UC1);
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

/// Near things bright; equal ratios of distance are equal steps of grey.
std::uint8_t depth_grey(float depth) {
    if (!std::isfinite(depth))
        return 0;
    const float clamped = std::clamp(depth, nearest, farthest);
    const float share = std::log(farthest / clamped) / std::log(farthest / nearest);
    return static_cast<std::uint8_t>(std::lround(255 * share));
}

/// Among the grain of an rgb frame zlib finds no strings that are there again, and looks for them
/// half of its time: without, files are 1 % smaller. Flat areas repeat, and the simplest of PNG's
/// filters, which OpenCV takes where no level is asked for, is enough for them.
std::vector<int> packing_of(const world::SensorFrame& frame, Texture texture) {
    if (frame.kind == world::SensorKind::semantic)
        return {cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE};
    if (frame.kind == world::SensorKind::depth || texture == Texture::flat)
        return {cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_DEFAULT};
    return {cv::IMWRITE_PNG_COMPRESSION,
            1,
            cv::IMWRITE_PNG_STRATEGY,
            cv::IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY};
}

}  // namespace

void write_png(const world::SensorFrame& frame,
               const std::filesystem::path& path,
               Texture texture) {
    REPRISE_CHECK(frame.width > 0 && frame.height > 0 && frame.type != world::PixelType::u16 &&
                      frame.data.size() == pixel_count(frame) * pixel_bytes(frame),
                  "frame " + frame.name + ": " + std::to_string(frame.data.size()) + " bytes");
    // Packed in memory, so that it is our stream that meets a full disk or a missing folder.
    std::vector<std::uint8_t> png;
    const bool packed = cv::imencode(".png", matrix_of(frame), png, packing_of(frame, texture));
    REPRISE_CHECK(packed, "OpenCV: " + path.string());
    files::write_file(path, "the picture", png);
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
        Rgb color{};
        if (frame.kind == world::SensorKind::depth)
            color.fill(depth_grey(depth_at(frame, i)));
        else if (frame.data[i] < cityscapes.size())
            color = cityscapes[frame.data[i]];
        std::copy(
            color.begin(), color.end(), picture.data.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return picture;
}

}  // namespace reprise::render
