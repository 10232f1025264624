#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "world/external/sensor.h"

namespace reprise::render {

/// How a direction becomes a place in the picture, and back, by OpenCV's models and names: of a
/// pinhole Brown and Conrady's k1, k2, p1, p2, k3 ("Close-range camera calibration", 1971), of a
/// fisheye Kannala and Brandt's k1 to k4 (2006), equidistant where these are 0. Places are in focal
/// lengths from the optical axis.
class Lens {
  public:
    Lens() = default;
    explicit Lens(const world::SensorSpec& spec);

    bool is_fisheye() const { return fisheye_; }

    /// Nothing but a pinhole, whose rays are straight lines in the picture.
    bool is_plain() const { return plain_; }

    /// Where a point of the camera's frame is seen. Beyond what the lens sees at all the picture is
    /// continued, so that places stay apart.
    Eigen::Vector2d place(const Eigen::Vector3d& p_camera) const;

    /// The direction that is seen at a place: of a fisheye a unit vector, else with z = 1. Nothing
    /// where the lens sees nothing.
    std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d& place) const;

    /// How far from the axis a direction is seen that is so far off it. [rad] A fisheye's.
    double radius(double angle) const;

    /// k1, k2, p1, p2, k3, or k1 to k4.
    std::vector<double> coefficients() const;

    friend bool operator==(const Lens& left, const Lens& right) = default;

  private:
    double bent(double r) const;
    double slope(double r) const;
    double straight(double wanted) const;
    Eigen::Vector2d distorted(const Eigen::Vector2d& flat) const;

    bool fisheye_ = false;
    bool plain_ = true;
    std::array<double, 4> radial_{};      ///< k1, k2, k3, k4
    std::array<double, 2> tangential_{};  ///< p1, p2
    double reach_ = 0;       ///< [focal lengths], [rad] of a fisheye: what is farther out is unseen
    double bent_reach_ = 0;  ///< where that is in the picture
};

}  // namespace reprise::render
