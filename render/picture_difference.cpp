#include "render/picture_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace reprise::render {

namespace {

/// Its numbers as they are, as doubles.
cv::Mat read(const std::filesystem::path& path, int& depth) {
    static const bool asked = setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1) == 0;
    cv::Mat picture;
    if (asked && (path.extension() == ".png" || path.extension() == ".exr"))
        picture = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
    depth = picture.depth();
    cv::Mat numbers;
    picture.convertTo(numbers, CV_64F);
    return numbers;
}

}  // namespace

std::optional<PictureDifference> picture_difference(const std::filesystem::path& expected,
                                                    const std::filesystem::path& found) {
    int depth = 0;
    int other = 0;
    const cv::Mat one = read(expected, depth);
    const cv::Mat two = read(found, other);
    if (one.empty() || one.size() != two.size() || one.type() != two.type() || depth != other)
        return std::nullopt;
    PictureDifference difference;
    difference.peak = depth == CV_8U ? 255 : depth == CV_16U ? 65535 : 0;
    const int channels = one.channels();
    for (int y = 0; y < one.rows; ++y)
        for (int x = 0; x < one.cols; ++x) {
            bool differs = false;
            for (int c = 0; c < channels; ++c) {
                const double left = one.ptr<double>(y)[x * channels + c];
                const double right = two.ptr<double>(y)[x * channels + c];
                if (left == right || (std::isnan(left) && std::isnan(right)))
                    continue;
                differs = true;
                const double apart = std::isfinite(left) && std::isfinite(right)
                                         ? std::abs(left - right)
                                         : std::numeric_limits<double>::infinity();
                difference.largest = std::max(difference.largest, apart);
                difference.squares += apart * apart;
            }
            if (differs && difference.pixels++ == 0) {
                difference.x = x;
                difference.y = y;
            }
        }
    difference.squares /= static_cast<double>(one.total()) * channels;
    return difference;
}

}  // namespace reprise::render
