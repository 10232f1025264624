#pragma once

#include <array>
#include <cstdint>

#include "render/trace/mesh_tree.h"

namespace reprise::render {

/// Up to 8 rays in one frame, for boxes in single and for triangles in double precision.
struct Bundle {
    static constexpr std::size_t lanes = Packet::lanes;

    alignas(16) std::array<std::array<double, lanes>, 3> origin;
    alignas(16) std::array<std::array<double, lanes>, 3> direction;
    std::array<std::uint32_t, lanes> masks;
    Packet packet;

    /// The lanes whose mask has a common bit with this one.
    unsigned lanes_matching(std::uint32_t mask) const;

    /// Fills the packet, but for `far`, after origin and direction have been set.
    void prepare();
};

/// Where rays cross a triangle.
struct TriangleHits {
    alignas(16) std::array<double, Bundle::lanes> distance;  ///< in lengths of the ray's direction
    alignas(16) std::array<double, Bundle::lanes> u;
    alignas(16) std::array<double, Bundle::lanes> v;
};

/// Returns the lanes among `wanted` that cross, from either side, ahead of their origins; edges
/// belong to both their triangles. What the other lanes of `hits` hold is undefined.
unsigned intersect_triangle(const MeshTree::Triangle& triangle,
                            const Bundle& bundle,
                            unsigned wanted,
                            TriangleHits& hits);

}  // namespace reprise::render
