#pragma once

#include <functional>
#include <unordered_map>
#include <vector>

#include "ground/mesh/ground.h"
#include "world/geometry2d.h"

namespace reprise::ground {

/// Height of a surface at a place in plan. [m]
using Height = std::function<double(const Eigen::Vector2d&)>;

/// Gathers triangles into a mesh: shares vertices, drops slivers, turns horizontal ones to face up.
class GroundBuilder {
  public:
    /// A convex polygon that faces up, whichever way round it comes.
    void add_face(const std::vector<Eigen::Vector3d>& corners, Surface surface);

    /// As above, from plan. Cut into cells of `cell` metres where the height is not linear (0:
    /// never).
    void add_face(const world::Loop& corners, const Height& height, double cell, Surface surface);

    /// The vertical face over an edge whose right side is the outside, from `bottom` to `top`
    /// (heights over the edge's own z).
    void add_wall(const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to,
                  double bottom,
                  double top,
                  Surface surface);

    /// A polygon that is counter-clockwise seen from above, `depth` metres lower, facing down.
    void add_ceiling(std::vector<Eigen::Vector3d> corners, double depth, Surface surface);

    /// A triangle as it comes, unless it is a sliver.
    void add_triangle(const Eigen::Vector3d& p,
                      const Eigen::Vector3d& q,
                      const Eigen::Vector3d& r,
                      Surface surface);

    const GroundMesh& mesh() const { return mesh_; }

    GroundMesh take() { return std::move(mesh_); }

  private:
    struct Hash {
        std::size_t operator()(const std::array<double, 3>& p) const;
    };

    std::uint32_t vertex(const Eigen::Vector3d& p);

    GroundMesh mesh_;
    /// Looked up, never walked through: the mesh's order is that of the calls.
    std::unordered_map<std::array<double, 3>, std::uint32_t, Hash> index_;
};

}  // namespace reprise::ground
