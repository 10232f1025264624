#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/town_generated.h"

namespace reprise::world {

/// A closed polygon in plan, seen from above. [m]
using Loop = std::vector<Eigen::Vector2d>;

/// An axis-parallel rectangle in plan. Empty at first. [m]
struct Box {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());

    void take(const Eigen::Vector2d& p, double margin = 0) {
        low = low.cwiseMin(p - Eigen::Vector2d::Constant(margin));
        high = high.cwiseMax(p + Eigen::Vector2d::Constant(margin));
    }

    void take(const Box& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }

    bool empty() const { return low.x() > high.x() || low.y() > high.y(); }
};

inline bool touch(const Box& one, const Box& other) {
    return one.low.y() <= other.high.y() && other.low.y() <= one.high.y() &&
           one.low.x() <= other.high.x() && other.low.x() <= one.high.x();
}

inline Eigen::Vector2d in_plan(const Vec3& p) {
    return {p.x(), p.y()};
}

inline double cross(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() * q.y() - p.y() * q.x();
}

/// Unit vector of a yaw [rad], counter-clockwise from east.
inline Eigen::Vector2d ahead_of(double yaw) {
    return {std::cos(yaw), std::sin(yaw)};
}

/// Unit vector to the left of a yaw. [rad]
inline Eigen::Vector2d left_of(double yaw) {
    return {-std::sin(yaw), std::cos(yaw)};
}

/// A vector turned by a quarter, counter-clockwise.
inline Eigen::Vector2d turned_left(const Eigen::Vector2d& v) {
    return {-v.y(), v.x()};
}

Loop in_plan(const std::vector<Vec3>& outline);
Loop in_plan(const std::vector<Eigen::Vector3d>& outline);

Box box_around(const Loop& loop, double margin = 0);

/// [m2]; positive when counter-clockwise.
double signed_area(const Loop& loop);

/// Winding number not zero: also right for loops that cross themselves. O(points).
bool contains(const Loop& loop, const Eigen::Vector2d& p);

/// Between a segment and a loop (or, with two points or one, what they are); 0 where they touch or
/// the segment lies inside. [m]; O(points).
double distance_to(const Loop& loop, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// Boxes by place: a uniform grid, built once. Answers are ascending and without repeats, so they
/// never depend on how the grid is laid out.
class BoxGrid {
  public:
    struct Entry {
        Box box;
        std::uint32_t item = 0;
    };

    BoxGrid() : BoxGrid(std::vector<Entry>()) {}

    /// Cells of `smallest_cell` metres, or larger in a town beyond 1024 of them a side.
    explicit BoxGrid(const std::vector<Entry>& entries, double smallest_cell = 16);

    /// Items with a box in the cells that `box` touches: all that overlap it, and some beside.
    std::vector<std::uint32_t> near(const Box& box) const;

    /// Items in the cell of `p`: all that hold it, and some beside. Ascending; O(1), of this grid's
    /// memory.
    std::span<const std::uint32_t> at(const Eigen::Vector2d& p) const;

  private:
    template <typename Visit>
    void for_each_cell(const Box& box, Visit&& visit) const;
    void put_in_order();

    Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
    double cell_ = 1;
    std::size_t columns_ = 1;
    std::size_t rows_ = 1;
    std::vector<std::uint32_t> begin_;  ///< [cell] into items_; one more than there are cells
    std::vector<std::uint32_t> items_;  ///< ascending within a cell
};

}  // namespace reprise::world
