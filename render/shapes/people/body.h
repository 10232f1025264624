#pragma once

#include <vector>

#include "render/shapes/mesh.h"
#include "render/shapes/people/posture.h"

namespace reprise::render {

/// Trunk, neck and head of a model with what is worn on them. Origin between the hip joints, z
/// along the spine, x ahead. About 1,500 triangles.
Mesh trunk_mesh(const world::WalkerModel& model);

/// What hangs from the hips: skirt, dress, gown or the tails of a coat; empty for others. Origin as
/// the trunk's, z up.
Mesh hem_mesh(const world::WalkerModel& model);

/// How far below the hips the hem ends; 0 without one. [m]
double hem_length(const world::WalkerModel& model);

/// Half sizes of the hem at this height over the hips. [m]
struct HemSize {
    double width;
    double depth;
};

/// The hem of a model that has one, for who asks for many heights.
class Hem {
  public:
    explicit Hem(const world::WalkerModel& model);

    HemSize at(double z) const;

  private:
    std::vector<double> heights_;  ///< rising
    std::vector<HemSize> sizes_;   ///< there
};

/// A shoe around the tip of its sole: x ahead, the ankle behind, length 1 from toe to ankle.
Mesh shoe_mesh();

/// Radius 1 around the origin.
Mesh ball_mesh();

/// From (0, 0, 0) to (0, 0, 1), round ends, radius 1 at the start and 0.72 at the end.
Mesh bone_mesh();

}  // namespace reprise::render
