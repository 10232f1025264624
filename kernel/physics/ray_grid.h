#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/physics/bullet/bullet.h"

class btOptimizedBvh;
class btTriangleCallback;

namespace reprise::kernel {

/// Short rays against a mesh's triangles, by a uniform grid in plan over the leaves of Bullet's
/// hierarchy. A wheel's ray is a metre long and nearly upright, so one cell holds all that it can
/// meet: a sixth of the work of a walk down the hierarchy, which 40 rays a tick would each begin at
/// its root.
///
/// Offers a callback exactly the triangles that btBvhTriangleMeshShape::performRaycast would, in
/// another order: the same tests of the same quantized boxes, which no box farther up can fail when
/// a leaf passes them.
class RayGrid {
  public:
    using Corners = std::array<btVector3, 3>;

    /// `triangles` by the indices that the hierarchy's leaves name. O(leaves + cells).
    RayGrid(btOptimizedBvh& hierarchy, std::vector<Corners> triangles);

    void cast(btTriangleCallback& callback, const btVector3& from, const btVector3& to) const;

  private:
    /// In the hierarchy's units: town / 65533 along each axis.
    struct Leaf {
        std::array<std::uint16_t, 3> low;
        std::array<std::uint16_t, 3> high;
        int triangle;
    };

    template <typename Visit>
    void for_each_cell(const Leaf& box, Visit&& visit) const;

    btOptimizedBvh* hierarchy_;
    std::vector<Corners> triangles_;
    int shift_ = 0;  ///< a cell is 2^shift units wide
    std::size_t columns_ = 1;
    std::vector<std::uint32_t> begin_;  ///< [cell] into leaves_; one more than there are cells
    std::vector<Leaf> leaves_;          ///< those of a cell together
};

}  // namespace reprise::kernel
