#pragma once

#include <vector>

#include "ground/mesh/ground_builder.h"
#include "ground/mesh/ribbon.h"

namespace reprise::ground {

/// Of painted lines over the road: nearer, and a depth picture cannot tell them apart. [m]
inline constexpr double paint_height = 0.005;
inline constexpr double line_width = 0.12;  ///< [m]

using Line = std::vector<Eigen::Vector3d>;

double length_of(const Line& line);

/// The part of a line between two arc lengths, from < to.
Line stretch(const Line& line, double from, double to);

/// A line of which many parts are asked for.
class MeasuredLine {
  public:
    /// `line` must outlive this.
    explicit MeasuredLine(const Line& line);

    double length() const { return passed_.back(); }

    /// As stretch(line, from, to), but without a walk to its start.
    Line stretch(double from, double to) const;

  private:
    const Line& line_;
    std::vector<double> passed_;  ///< [m] to each of its points; 0 of an empty line
};

/// Gathers what is painted on roads.
class Paint {
  public:
    /// A line of this width along a clean line on the road.
    void line(const Line& line, double width);

    /// A convex polygon on a lane: corners (s, t) are metres along its clean centre line (may lie
    /// between 0 and its length only) and to the left of it. Follows bends and slopes.
    void shape(const Line& centre, const world::Loop& corners);

    GroundBuilder& builder() { return builder_; }

  private:
    GroundBuilder builder_;
};

}  // namespace reprise::ground
