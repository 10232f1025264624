#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace reprise::traffic {

/// Turns the way of a front bumper into poses: the rear axle follows where the front has been. A
/// two-wheeler heads along the last 2.5 m of that way: its own length would turn it by 11 degrees
/// within a tick where lanes meet at an angle, its rider leans into a bend before that.
/// SUMO gives the front's place only loosely tied to an angle (in a lane change its angle leaves
/// the path by tens of degrees); this one is smooth on curves, bends, slopes and lane changes
/// alike.
class Trail {
  public:
    static constexpr double least_reach = 2.5;  ///< [m] of its way that a body points along

    /// As if the car had come straight: `front` is the bumper, `behind` a unit vector to the rear,
    /// `distance` [m] from bumper to rear axle.
    void start(const Eigen::Vector3d& front, const Eigen::Vector3d& behind, double distance);

    /// Puts a point behind the oldest one, to start on a bend.
    void start(const std::vector<Eigen::Vector3d>& from_rear_to_front, double distance);

    /// The bumper moves on. O(1) on average.
    void advance(const Eigen::Vector3d& front);

    /// Where the rear axle is, on the ground.
    Eigen::Vector3d rear() const;

    /// From where the body points to its bumper: the rear axle's place; further back on the way
    /// where that is nearer than least_reach.
    Eigen::Vector3d heads_from() const;

    /// Where the bumper was when it had `distance` [m] less behind it; no further back than the
    /// rear axle is. O(log points).
    Eigen::Vector3d behind(double distance) const;

    const Eigen::Vector3d& front() const { return front_; }

    /// [m] by the bumper so far.
    double travelled() const { return travelled_; }

    /// Of every point so far: with the bumper's place and travelled() it tells all that decides
    /// where the rear axle will be.
    std::uint64_t points_digest() const { return points_digest_; }

  private:
    void add_point();
    Eigen::Vector3d between(std::size_t at, double travelled) const;

    struct Point {
        Eigen::Vector3d position;
        double travelled = 0;  ///< [m] by the bumper when it was there
    };

    std::vector<Point> points_;  ///< oldest first
    std::size_t at_ = 0;         ///< reach_ lies at or after points_[at_]
    Eigen::Vector3d front_ = Eigen::Vector3d::Zero();
    double travelled_ = 0;             ///< [m] by the bumper so far
    double distance_ = 0;              ///< [m] from bumper to rear axle
    double reach_ = 0;                 ///< [m] behind the bumper, by its way: the body points there
    std::uint64_t points_digest_ = 0;  ///< of every point so far, in their order
};

}  // namespace reprise::traffic
