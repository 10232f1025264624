#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/digest.h"
#include "world/tick_generated.h"

namespace reprise::world {

/// A way through places at times, as `follow` says it.
///
/// MUST    pass every point at its time; never leave, in east or in north, the range between two
///         neighbouring points; be a pure function of the points and the time.
/// ASSUMES at least two points, times strictly rising.
/// GOES    for east, north and the heading apart: a piecewise cubic with the slopes of F. N.
/// Fritsch
///         and J. Butland, "A method for constructing local monotone piecewise cubic interpolants",
///         SIAM J. Sci. Stat. Comput. 5 (1984), as MATLAB's and SciPy's pchip. Points at an even
///         speed on a line are passed at that speed. Up: straight from point to point.
/// KEEPS   the points and their slopes.
class Trajectory {
  public:
    /// `has_headings`: the points' headings count; else it heads where it goes.
    Trajectory(std::span<const PathPoint> points, bool has_headings);

    /// [s] of the first and the last point.
    double start() const { return times_.front(); }

    double end() const { return times_.back(); }

    struct State {
        Eigen::Vector3d position;       ///< world
        Eigen::Vector2d velocity;       ///< [m/s] world, in plan
        std::optional<double> heading;  ///< [rad] in (-pi, pi]; none: stands, as it stood before
        double turn_rate = 0;           ///< [rad/s]
    };

    /// At this time, kept within [start, end]; heading where it goes from 0.05 m/s on.
    State at(double time) const;

    /// Where it will head first.
    std::optional<double> first_heading() const;

    void add_to(Hasher& hasher) const;

  private:
    /// One number over time.
    struct Curve {
        std::vector<double> values;
        std::vector<double> slopes;  ///< [1/s]
    };

    struct Sample {
        double value = 0;
        double rate = 0;
        double change = 0;  ///< of the rate [1/s^2]
    };

    Sample sample(const Curve& curve, std::size_t piece, double time) const;
    void find_slopes(Curve& curve) const;
    double end_slope(const Curve& curve, std::size_t end, std::size_t next, std::size_t far) const;

    std::vector<double> times_;
    Curve east_;
    Curve north_;
    Curve heading_;  ///< empty: where it goes
    std::vector<double> up_;
};

/// How many ticks after its time 0 the last tick of a trajectory is; `step` [s].
std::uint64_t last_tick_of(std::span<const PathPoint> points, double step);

}  // namespace reprise::world
