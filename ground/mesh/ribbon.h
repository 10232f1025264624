#pragma once

#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// The surface that a line sweeps: for lanes, paths and painted lines.
struct Ribbon {
    std::vector<Eigen::Vector3d> left;  ///< one for each point of the line
    std::vector<Eigen::Vector3d> right;

    /// Pieces that cover it, counter-clockwise, with 3 or 4 corners.
    std::vector<std::vector<Eigen::Vector3d>> pieces;

    /// Do `left` and `right` bound it? Not where the line bends more tightly than it is wide: the
    /// pieces then overlap each other on the inside of the bend.
    bool simple = false;

    /// In plan: one loop when simple, else one for each piece.
    std::vector<world::Loop> loops() const;
};

/// Points without repeats (closer than 1 cm), at least two, extended by `overlap` at both ends.
std::vector<Eigen::Vector3d> clean_line(const std::vector<world::Vec3>& line, double overlap = 0);

/// The same line with points between its own, evenly, so that no two are farther apart than
/// `spacing`. [m]
std::vector<Eigen::Vector3d> with_more_points(const std::vector<Eigen::Vector3d>& line,
                                              double spacing);

/// From `right` to `left` of a clean line, metres left of it, with mitred corners. z is the line's.
Ribbon make_ribbon(const std::vector<Eigen::Vector3d>& line, double right, double left);

/// The line moved sideways, in plan, with mitred corners clamped to twice the offset.
std::vector<Eigen::Vector3d> moved_left(const std::vector<Eigen::Vector3d>& line, double offset);

/// Height of a clean line at the point nearest to p in plan. [m]
double height_along(const std::vector<Eigen::Vector3d>& line, const Eigen::Vector2d& p);

}  // namespace reprise::ground
