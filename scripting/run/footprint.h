#pragma once

#include <Eigen/Core>

namespace reprise::scripting {

/// What an actor covers of the ground: an upright box. World, metres.
struct Footprint {
    Eigen::Vector3d centre{0, 0, 0};  ///< on the ground
    double yaw = 0;
    double half_length = 0;
    double half_width = 0;
};

/// How far two of them reach into each other: by so much one had to move. 0: they do not; they may
/// touch. Nor do those on and below a bridge. [m]
double overlap(const Footprint& one, const Footprint& other);

}  // namespace reprise::scripting
