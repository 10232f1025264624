#pragma once

#include <vector>

#include <Eigen/Core>

#include "world/town_generated.h"

namespace reprise::ground {

/// Where a surface is not flat it is cut into cells of this size. [m]
inline constexpr double surface_cell = 2.0;

/// The height of one connected surface - one level - as a function of the place in plan.
class SurfaceHeight {
  public:
    SurfaceHeight() = default;

    /// Through all of these lines, smooth between them: mean of points on the lines, weighted by
    /// distance^-4 (Shepard, "A two-dimensional interpolation function for irregularly-spaced
    /// data", 1968).
    explicit SurfaceHeight(const std::vector<std::vector<world::Vec3>>& lines);

    /// That of the nearest point of one clean line (see ribbon.h): level across it.
    static SurfaceHeight along(std::vector<Eigen::Vector3d> line);

    double at(const Eigen::Vector2d& p) const;

    /// Is it one plane, so that it need not be cut into cells?
    bool is_plane() const { return is_plane_; }

    /// Of the plane that fits best. [m/m], east and north.
    const Eigen::Vector2d& slope() const { return slope_; }

  private:
    bool is_plane_ = true;
    Eigen::Vector3d base_ = Eigen::Vector3d::Zero();  ///< a point of the plane
    Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();
    std::vector<Eigen::Vector3d> residues_;  ///< samples, a metre apart; z is off the plane
    std::vector<Eigen::Vector3d> line_;      ///< as given to along()
};

}  // namespace reprise::ground
