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
