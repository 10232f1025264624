// Text on a map's sheet, and labels on the map itself that do not overlap.
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "render/map/map_canvas.h"

namespace reprise::render {

namespace {

constexpr int plain_font = cv::FONT_HERSHEY_SIMPLEX;
constexpr int bold_font = cv::FONT_HERSHEY_DUPLEX;

}  // namespace

double MapCanvas::font_scale(double height_pixels, bool bold) const {
    constexpr int thickness = 1;
    return cv::getFontScaleFromHeight(
        bold ? bold_font : plain_font, std::max(1, cvRound(height_pixels * finer_)), thickness);
}

double MapCanvas::text_width(const std::string& text, double height_pixels, bool bold) const {
    int baseline = 0;
    const cv::Size size = cv::getTextSize(
        text, bold ? bold_font : plain_font, font_scale(height_pixels, bold), 1, &baseline);
    return static_cast<double>(size.width) / finer_;
}

/// Marks an area as taken by a label, if it is free and on the map.
bool MapCanvas::take(const cv::RotatedRect& area) {
    const cv::Rect around = area.boundingRect();
    if ((around & cv::Rect(cv::Point(), map_part_.size())) != around)
        return false;
    cv::Point2f corners[4];
    area.points(corners);
    std::vector<cv::Point> outline;
    for (const cv::Point2f& corner : corners)
        outline.push_back(cv::Point(corner) - around.tl());
    cv::Mat mask = cv::Mat::zeros(around.size(), CV_8UC1);
    cv::fillConvexPoly(mask, outline, cv::Scalar(255));
    cv::Mat overlap;
    cv::bitwise_and(mask, taken_(around), overlap);
    if (cv::countNonZero(overlap) > 0)
        return false;
    mask.copyTo(taken_(around), mask);
    return true;
}

void MapCanvas::blend(const cv::Mat& coverage, const cv::Point& corner, Ink ink, double strength) {
    const int target[] = {ink.blue, ink.green, ink.red};
    for (int row = 0; row < coverage.rows; ++row)
        for (int column = 0; column < coverage.cols; ++column) {
            const double share = strength * coverage.at<std::uint8_t>(row, column) / 255.0;
            auto& pixel = map_part_.at<cv::Vec3b>(corner.y + row, corner.x + column);
            for (int c = 0; c < 3; ++c)
                pixel[c] = static_cast<std::uint8_t>(
                    std::lround(pixel[c] + share * (target[c] - pixel[c])));
        }
}

bool MapCanvas::label(const std::string& text,
                      const Eigen::Vector2d& place,
                      double angle,
                      double height_pixels) {
    const double scale = font_scale(height_pixels, false);
    const int stroke = std::max(1, cvRound(height_pixels * finer_ / 8));
    const int rim = 4 * stroke;
    int baseline = 0;
    const cv::Size size = cv::getTextSize(text, plain_font, scale, stroke, &baseline);
    const cv::Point2d middle = cv::Point2d(on_map({place})[0]) / (1 << fraction_bits);
    const double degrees = angle * 180 / CV_PI;
    const cv::RotatedRect area(cv::Point2f(middle),
                               cv::Size2f(cv::Size(size.width + 3 * rim, size.height + 3 * rim)),
                               static_cast<float>(-degrees));
    if (!take(area))
        return false;

    // Written level beside the map, then turned about the text's middle into its place.
    const cv::Rect around = area.boundingRect();
    const cv::Point2f level_middle(static_cast<float>(rim + size.width / 2),
                                   static_cast<float>(rim + size.height / 2));
    cv::Mat move = cv::getRotationMatrix2D(level_middle, degrees, 1.0);
    move.at<double>(0, 2) += middle.x - around.x - static_cast<double>(level_middle.x);
    move.at<double>(1, 2) += middle.y - around.y - static_cast<double>(level_middle.y);
    for (const int thickness : {rim, stroke}) {
        cv::Mat level =
            cv::Mat::zeros(size.height + baseline + 2 * rim, size.width + 2 * rim, CV_8UC1);
        cv::putText(level,
                    text,
                    {rim, rim + size.height},
                    plain_font,
                    scale,
                    cv::Scalar(255),
                    thickness,
                    cv::LINE_AA);
        cv::Mat coverage;
        cv::warpAffine(level, coverage, move, around.size(), cv::INTER_LINEAR);
        if (thickness == rim)
            blend(coverage, around.tl(), {250, 249, 244}, 0.75);
        else
            blend(coverage, around.tl(), letters, 1);
    }
    return true;
}

void MapCanvas::reserve(const Eigen::Vector2d& place, double radius_pixels) {
    const int radius = static_cast<int>(std::lround(radius_pixels * finer_ * (1 << fraction_bits)));
    cv::circle(
        taken_, on_map({place})[0], radius, cv::Scalar(255), cv::FILLED, cv::LINE_8, fraction_bits);
}

void MapCanvas::write(
    const std::string& text, double x, double y, double height_pixels, Ink ink, bool bold) {
    const int stroke = std::max(1, cvRound(height_pixels * finer_ / (bold ? 7 : 9)));
    cv::putText(sheet_,
                text,
                {cvRound(x * finer_), cvRound(y * finer_)},
                bold ? bold_font : plain_font,
                font_scale(height_pixels, bold),
                ink.scalar(),
                stroke,
                cv::LINE_AA);
}

}  // namespace reprise::render
