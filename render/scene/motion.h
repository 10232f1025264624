#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "render/scene/scene.h"

namespace reprise::render {

/// For each moving instance of `scene` the one that is the same part of the same actor at the other
/// tick; null where there is none.
std::vector<const Instance*> partners(const Scene& scene, const Scene& other);

/// The way of one part between two ticks: it goes straight, and turns evenly.
struct Motion {
    Eigen::Vector3d from{0, 0, 0};  ///< of its origin, scene
    Eigen::Vector3d to{0, 0, 0};
    Eigen::Quaterniond turn{1, 0, 0, 0};  ///< from its attitude to that there
    bool moves = false;

    /// Takes it from here to a share of the way, in [0, 1].
    Eigen::Affine3d at(double share) const;
};

/// Of each moving instance of `scene`, to where it was at `other`: what was not there, or jumped,
/// stays. What turns by more than half a turn between ticks, as wheels of fast cars, turns the
/// shorter way.
std::vector<Motion> motions(const Scene& scene, const Scene& other);

}  // namespace reprise::render
