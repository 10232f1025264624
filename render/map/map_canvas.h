// Private to the room: what a map is painted on.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "world/geometry2d.h"

namespace reprise::render {

/// sRGB.
struct Ink {
    int red = 0;
    int green = 0;
    int blue = 0;

    cv::Scalar scalar() const { return cv::Scalar(blue, green, red); }

    /// Darker below 1, brighter above.
    Ink times(double factor) const;
};

inline constexpr Ink white{255, 255, 255};
inline constexpr Ink letters{48, 52, 58};

/// A sheet with a map on it. Everything is painted several times larger and made smaller at the
/// end: smooth edges without seams between triangles that meet.
class MapCanvas {
  public:
    /// Of a pixel, in OpenCV's fixed-point coordinates.
    static constexpr int fraction_bits = 4;

    /// A sheet of about `size` pixels on its longer side, with `region` as large as fits between a
    /// heading and a legend of `legend_rows`.
    MapCanvas(const world::Box& region, int size, int legend_rows, Ink land);

    // On the map, in metres; what lies outside of the region is cut off.
    void fill(const world::Loop& polygon, Ink ink);
    void line(const world::Loop& points, double width_pixels, Ink ink, bool closed = false);
    void disc(const Eigen::Vector2d& centre, double radius_pixels, Ink ink);
    /// Symbols: corners in pixels around a place, x to the right and y up, turned by `yaw`.
    void symbol(const Eigen::Vector2d& place, double yaw, const world::Loop& corners, Ink ink);
    /// Everything within the polygons becomes darker, once. 0: black.
    void shade(const std::vector<world::Loop>& polygons, double factor);

    /// Writes along `angle` (within a quarter turn of level), centred, unless something is written
    /// there already or it does not fit on the map. Says whether it did.
    bool label(const std::string& text,
               const Eigen::Vector2d& place,
               double angle,
               double height_pixels);

    /// Keeps labels away from a place.
    void reserve(const Eigen::Vector2d& place, double radius_pixels);

    // On the sheet, in pixels from its top left corner.
    void write(const std::string& text,
               double x,
               double y,
               double height_pixels,
               Ink ink,
               bool bold = false);
    void box(double x, double y, double width, double height, Ink ink);
    void polygon(const world::Loop& corners, Ink ink);
    void dot(double x, double y, double radius, Ink ink);

    double text_width(const std::string& text, double height_pixels, bool bold = false) const;

    double pixels_per_metre() const { return scale_; }

    double unit() const { return unit_; }  ///< [pixels] that are one pixel of a sheet of 1600

    double width() const { return width_; }

    double height() const { return height_; }

    cv::Rect2d map() const { return map_; }  ///< of the sheet

    /// The sheet in its true size, as BGR.
    cv::Mat finish() const;

  private:
    cv::Point fixed(const Eigen::Vector2d& sheet) const;
    Eigen::Vector2d on_sheet(const Eigen::Vector2d& p_world) const;
    std::vector<cv::Point> on_map(const world::Loop& world_points) const;
    bool take(const cv::RotatedRect& area);
    void blend(const cv::Mat& coverage, const cv::Point& corner, Ink ink, double strength);
    double font_scale(double height_pixels, bool bold) const;
    cv::Rect inside() const;

    world::Box region_;
    double scale_ = 1;
    double unit_ = 1;
    int finer_ = 1;  ///< times larger than the result
    int width_ = 0;
    int height_ = 0;
    cv::Rect2d map_;
    cv::Mat sheet_;
    cv::Mat map_part_;  ///< of sheet_
    cv::Mat taken_;     ///< of the map part: where labels are
};

}  // namespace reprise::render
