#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/shapes/mesh.h"
#include "render/trace/bounding_volumes.h"

namespace reprise::render {

/// A mesh's triangles in a tree.
class MeshTree {
  public:
    explicit MeshTree(const Mesh& mesh);

    struct Triangle {
        std::array<std::array<float, 3>, 3> corners;
        std::uint32_t number;  ///< in the mesh
    };

    const BoundingVolumes& tree() const { return tree_; }

    /// In the order of the tree's leaves.
    std::span<const Triangle> triangles() const { return triangles_; }

    const Box& bound() const { return bound_; }

  private:
    BoundingVolumes tree_;
    std::vector<Triangle> triangles_;
    Box bound_;
};

}  // namespace reprise::render
