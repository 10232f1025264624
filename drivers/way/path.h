#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/digest.h"

namespace reprise::drivers {

/// A sample of the driver's path. Yaw runs on without wrapping, so that differences are turns.
struct PathPoint {
    Eigen::Vector3d position;   ///< world
    Eigen::Vector2d direction;  ///< unit, in plan
    double yaw = 0;             ///< [rad] unwrapped
    double curvature = 0;       ///< [1/m] left positive, smoothed over the steps of a polyline
    double limit = 0;           ///< [m/s] what the lane allows
    double squared_speed = 0;   ///< [m^2/s^2] envelope: limits, curves, and braking towards them
};

/// How far a vehicle reaches to both sides of a path while it passes there. [m]
struct SweptWidth {
    double left = 0;
    double right = 0;
};

/// What the envelope of speeds is made of.
struct PathComfort {
    double lateral_acceleration = 2.5;
    double deceleration = 2;
};

/// The way ahead as one polyline, resampled every half metre. Distances along it are counted from
/// where the driver started and stay valid when the part behind is dropped.
class Path {
  public:
    static constexpr double spacing = 0.5;

    void clear();

    bool empty() const { return points_.empty(); }

    double start() const { return static_cast<double>(first_) * spacing; }

    /// Where the appended polylines end; at most `spacing` beyond the last sample.
    double end() const { return end_; }

    /// Goes on along a polyline; its first point is where the last one ended.
    void append(std::span<const Eigen::Vector3d> polyline, double limit);

    /// Computes direction, curvature and envelope after appending. O(points).
    void finish(const PathComfort& comfort);

    void drop_before(double s);

    /// Interpolated; s is clamped to [start, end].
    PathPoint at(double s) const;

    /// Turn per metre over +- reach. [1/m]
    double curvature(double s, double reach) const;

    /// Sine of its slope over +- reach; positive where it leads uphill.
    double climb(double s, double reach) const;

    /// The distance of the point of the path nearest to p in plan, in [from, from + reach].
    /// O(points / 16) where the path leads away from p.
    double project(const Eigen::Vector3d& p_world, double from, double reach) const;

    std::span<const PathPoint> points() const { return points_; }

    /// Index in points() of the last sample at or before s, clamped.
    std::size_t index(double s) const;

    void add_to(world::Hasher& hasher) const;

    double s_of(std::size_t index) const { return static_cast<double>(first_ + index) * spacing; }

  private:
    double least_sample(const Eigen::Vector2d& p, std::size_t first, std::size_t last) const;

    std::vector<PathPoint> points_;
    std::size_t first_ = 0;  ///< samples dropped so far
    double end_ = 0;
    Eigen::Vector3d tail_ = Eigen::Vector3d::Zero();  ///< where the polylines end
    double rest_ = 0;                                 ///< [m] from the last sample to the tail
};

}  // namespace reprise::drivers
