#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"

namespace reprise::towns {

/// A rectangle on the ground. Metres and radians.
struct Footprint {
    Eigen::Vector2d centre;
    double yaw = 0;
    double length = 0;  ///< along its own x
    double width = 0;
};

/// Counter-clockwise, from the corner at -x, -y of its own frame.
world::Loop corners(const Footprint& footprint);

/// How far a footprint is from everything that stands or is driven on, seen from above (levels are
/// not told apart: under a bridge is not free either). Obstacles are line segments with a
/// thickness, and polygons, in a uniform grid; the answer is exact up to `reach`.
class Clearance {
  public:
    /// Distances from `reach` on are reported as `reach`. [m]
    explicit Clearance(double reach) : reach_(reach) {}

    /// A strip around a polyline.
    void add_line(const std::vector<world::Vec3>& line, double half_width);

    void add_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_width) {
        add_segment({from, to, half_width});
    }

    /// A polygon's border and inside, wound either way; it may cross itself.
    void add_polygon(const world::Loop& loop);
    void add_polygon(const std::vector<world::Vec3>& outline);

    void add_point(const Eigen::Vector2d& point, double radius = 0);

    void add_footprint(const Footprint& footprint) { add_polygon(corners(footprint)); }

    /// [m] between the footprint and the nearest obstacle, at most `reach`; negative when they
    /// overlap. A footprint of no size is a point.
    double of(const Footprint& footprint) const { return nearest(footprint, reach_, -reach_); }

    double of(const Eigen::Vector2d& point) const { return of(Footprint{point, 0, 0, 0}); }

    /// of(footprint) >= margin, which may not be beyond `reach`; quicker.
    bool is_clear(const Footprint& footprint, double margin) const {
        return nearest(footprint, margin, margin) >= margin;
    }

    bool is_clear(const Eigen::Vector2d& point, double margin) const {
        return is_clear(Footprint{point, 0, 0, 0}, margin);
    }

  private:
    struct Segment {
        Eigen::Vector2d from;
        Eigen::Vector2d to;
        double half_width = 0;
    };

    struct Cell {
        std::vector<std::uint32_t> segments;
        std::vector<std::uint32_t> loops;  ///< those whose box touches the cell
    };

    void add_segment(const Segment& segment);

    /// The distance if it is below `reach`, else `reach`; below `enough` any number will do.
    double nearest(const Footprint& footprint, double reach, double enough) const;

    double reach_;
    std::vector<Segment> segments_;
    std::vector<world::Loop> loops_;
    std::unordered_map<std::uint64_t, Cell> cells_;  ///< looked up, never walked through
};

}  // namespace reprise::towns
