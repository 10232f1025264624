#pragma once

#include <vector>

#include "render/shapes/mesh.h"

namespace reprise::render {

/// Adds shapes to a mesh, in a frame of their own. [m]
class Builder {
  public:
    Builder(Mesh& mesh, const Eigen::Isometry3f& pose) : mesh_(mesh), pose_(pose) {}

    const Eigen::Isometry3f& pose() const { return pose_; }

    /// One that adds to the same mesh in another frame.
    Builder in(const Eigen::Isometry3f& pose) const { return {mesh_, pose}; }

    void box(const Eigen::Vector3f& low,
             const Eigen::Vector3f& high,
             Finish finish,
             unsigned without = 0);

    /// Corners counter-clockwise seen from outside.
    void quad(const std::array<Eigen::Vector3f, 4>& corners, Finish finish);
    void triangle(const std::array<Eigen::Vector3f, 3>& corners, Finish finish);

    void tube(const Tube& tube, Finish finish);

    /// A convex face with something of this thickness below it: corners counter-clockwise seen from
    /// above.
    void plate(const std::vector<Eigen::Vector3f>& corners,
               float thickness,
               Finish top,
               Finish rest);

    /// From a square of half size `low` at `foot` to one of half size `high`, `height` above it.
    void frustum(const Eigen::Vector3f& foot, float low, float high, float height, Finish finish);

    /// Round about the vertical through `foot`: pairs of radius and height above it, upwards.
    void lathe(const Eigen::Vector3f& foot,
               const std::vector<Eigen::Vector2f>& profile,
               int sides,
               Finish finish);

  private:
    Mesh& mesh_;
    Eigen::Isometry3f pose_;
};

}  // namespace reprise::render
