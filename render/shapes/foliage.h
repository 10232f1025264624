#pragma once

#include "render/shapes/mesh.h"
#include "render/shapes/noise.h"

namespace reprise::render {

/// A counter-based random generator: the n-th number is the hash of seed and n, equal on every
/// machine.
class HashRandom {
  public:
    explicit HashRandom(std::uint32_t seed) : seed_(seed) {}

    float next() { return unit(hash(seed_, count_++)); }

    std::uint32_t bits() { return hash(seed_, count_++); }

    /// A unit vector, all directions alike.
    Eigen::Vector3f direction();

  private:
    std::uint32_t seed_;
    std::uint32_t count_ = 0;
};

/// Bunches of leaves around a bough. Plants have height 1 and crown radius 1, to be stretched:
/// `slenderness` is the crown's radius over the height once they are.
struct LeafBunch {
    Eigen::Vector3f centre;
    float radius;  ///< in crown radii
    int count;
    float smallest;  ///< half the length of a leaf bunch, in crown radii
    float spread;    ///< the largest is so much larger
    float slenderness;
    float aspect = 1;  ///< height of the bough over its width, once stretched
};

/// Appends leaves with normals of their own: the mesh's other triangles must have theirs.
void add_leaves(Mesh& mesh, const LeafBunch& bunch, HashRandom& random);

}  // namespace reprise::render
