#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "world/common_generated.h"

namespace reprise::traffic {

/// A rectangle on the ground. Metres and radians.
struct Footprint {
    Eigen::Vector2d centre;
    double yaw = 0;
    double length = 0;  ///< along its own x
    double width = 0;
};

/// How far a footprint is from everything that stands or is driven on, seen from above (levels are
/// not told apart: under a bridge is not free either). Obstacles are line segments with a
/// thickness, in a uniform grid; the answer is exact up to `reach`.
class Clearance {
  public:
    /// Distances from `reach` on are reported as `reach`. [m]
    explicit Clearance(double reach) : reach_(reach) {}

    /// A strip around a polyline.
    void add_line(const std::vector<world::Vec3>& line, double half_width);

    /// A polygon's border and inside.
    void add_polygon(const std::vector<world::Vec3>& outline);

    void add_footprint(const Footprint& footprint);

    /// [m] between the footprint and the nearest obstacle, at most `reach`; negative when they
    /// overlap. A footprint of no size is a point.
    double of(const Footprint& footprint) const;

  private:
    struct Segment {
        Eigen::Vector2d from;
        Eigen::Vector2d to;
        double half_width = 0;
    };

    using Cell = std::pair<std::int32_t, std::int32_t>;

    void add_segment(const Segment& segment);

    double reach_;
    std::vector<Segment> segments_;
    std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace reprise::traffic
