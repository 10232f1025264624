#include "render/map/map_canvas.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace reprise::render {

namespace {

constexpr int fraction_bits = MapCanvas::fraction_bits;

// [pixels] of a sheet of 1600
constexpr double heading = 62;
constexpr double legend_row = 27;
constexpr double rim = 18;
constexpr double narrowest = 1000;

}  // namespace

Ink Ink::times(double factor) const {
    const auto scaled = [&](int value) {
        return std::clamp(static_cast<int>(std::lround(value * factor)), 0, 255);
    };
    return {scaled(red), scaled(green), scaled(blue)};
}

MapCanvas::MapCanvas(const world::Box& region, int size, int legend_rows, Ink land)
    : region_(region) {
    constexpr int usual_size = 1600;
    constexpr int finest = 4800;  // [pixels] of the larger sheet
    unit_ = static_cast<double>(size) / usual_size;
    finer_ = std::clamp(finest / size, 1, 4);
    const Eigen::Vector2d metres = region.high - region.low;
    const double below = (legend_rows * legend_row + 14) * unit_ + rim * unit_;
    const double across = size - 2 * rim * unit_;
    const double down = size - heading * unit_ - below;
    scale_ = std::min(across / metres.x(), down / metres.y());
    const Eigen::Vector2d map = metres * scale_;
    width_ = static_cast<int>(std::lround(std::max(map.x() + 2 * rim * unit_, narrowest * unit_)));
    height_ = static_cast<int>(std::lround(map.y() + heading * unit_ + below));
    map_ = cv::Rect2d((width_ - map.x()) / 2, heading * unit_, map.x(), map.y());
    sheet_ = cv::Mat(height_ * finer_, width_ * finer_, CV_8UC3, Ink{252, 251, 248}.scalar());
    map_part_ = sheet_(inside());
    map_part_.setTo(land.scalar());
    taken_ = cv::Mat::zeros(map_part_.size(), CV_8UC1);
}

/// The map's part of the larger sheet.
cv::Rect MapCanvas::inside() const {
    const cv::Rect all(0, 0, sheet_.cols, sheet_.rows);
    return all & cv::Rect(cvRound(map_.x * finer_),
                          cvRound(map_.y * finer_),
                          cvRound(map_.width * finer_),
                          cvRound(map_.height * finer_));
}

Eigen::Vector2d MapCanvas::on_sheet(const Eigen::Vector2d& p_world) const {
    return {map_.x + (p_world.x() - region_.low.x()) * scale_,
            map_.y + (region_.high.y() - p_world.y()) * scale_};
}

/// OpenCV counts from the middle of the first pixel.
cv::Point MapCanvas::fixed(const Eigen::Vector2d& sheet) const {
    const Eigen::Vector2d p = (sheet * finer_ - Eigen::Vector2d(0.5, 0.5)) * (1 << fraction_bits);
    return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
}

std::vector<cv::Point> MapCanvas::on_map(const world::Loop& world_points) const {
    const cv::Point corner(inside().x << fraction_bits, inside().y << fraction_bits);
    std::vector<cv::Point> points;
    points.reserve(world_points.size());
    for (const Eigen::Vector2d& p : world_points)
        points.push_back(fixed(on_sheet(p)) - corner);
    return points;
}

void MapCanvas::fill(const world::Loop& polygon, Ink ink) {
    const std::vector<cv::Point> points = on_map(polygon);
    if (points.size() == 3)
        cv::fillConvexPoly(map_part_, points, ink.scalar(), cv::LINE_8, fraction_bits);
    else if (points.size() > 3)
        cv::fillPoly(map_part_, std::vector{points}, ink.scalar(), cv::LINE_8, fraction_bits);
}

void MapCanvas::line(const world::Loop& points, double width_pixels, Ink ink, bool closed) {
    const int thickness = std::max(1, static_cast<int>(std::lround(width_pixels * finer_)));
    cv::polylines(map_part_,
                  std::vector{on_map(points)},
                  closed,
                  ink.scalar(),
                  thickness,
                  cv::LINE_AA,
                  fraction_bits);
}

void MapCanvas::disc(const Eigen::Vector2d& centre, double radius_pixels, Ink ink) {
    const int radius = static_cast<int>(std::lround(radius_pixels * finer_ * (1 << fraction_bits)));
    cv::circle(map_part_,
               on_map({centre})[0],
               radius,
               ink.scalar(),
               cv::FILLED,
               cv::LINE_AA,
               fraction_bits);
}

void MapCanvas::symbol(const Eigen::Vector2d& place,
                       double yaw,
                       const world::Loop& corners,
                       Ink ink) {
    const Eigen::Vector2d along(std::cos(yaw), std::sin(yaw));
    const Eigen::Vector2d left(-along.y(), along.x());
    world::Loop turned;
    for (const Eigen::Vector2d& corner : corners)
        turned.push_back(place + (along * corner.x() + left * corner.y()) / scale_);
    cv::fillPoly(map_part_, std::vector{on_map(turned)}, ink.scalar(), cv::LINE_AA, fraction_bits);
}

void MapCanvas::shade(const std::vector<world::Loop>& polygons, double factor) {
    cv::Mat mask = cv::Mat::zeros(map_part_.size(), CV_8UC1);
    for (const world::Loop& polygon : polygons)
        if (polygon.size() > 2)
            cv::fillPoly(
                mask, std::vector{on_map(polygon)}, cv::Scalar(255), cv::LINE_8, fraction_bits);
    cv::Mat darker;
    map_part_.convertTo(darker, -1, factor);
    darker.copyTo(map_part_, mask);
}

void MapCanvas::box(double x, double y, double width, double height, Ink ink) {
    polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, ink);
}

void MapCanvas::polygon(const world::Loop& corners, Ink ink) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& corner : corners)
        points.push_back(fixed(corner));
    cv::fillPoly(sheet_, std::vector{points}, ink.scalar(), cv::LINE_AA, fraction_bits);
}

void MapCanvas::dot(double x, double y, double radius, Ink ink) {
    cv::circle(sheet_,
               fixed({x, y}),
               static_cast<int>(std::lround(radius * finer_ * (1 << fraction_bits))),
               ink.scalar(),
               cv::FILLED,
               cv::LINE_AA,
               fraction_bits);
}

cv::Mat MapCanvas::finish() const {
    cv::Mat result;
    cv::resize(sheet_, result, cv::Size(width_, height_), 0, 0, cv::INTER_AREA);
    return result;
}

}  // namespace reprise::render
