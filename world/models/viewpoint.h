#pragma once

#include "world/models/actors.h"

namespace reprise::world {

/// Whether a camera at this place of the actor's own frame is inside of it, or so near (half a
/// metre) that it is taken to be fixed to it, as on a roof or a mirror. Such a camera does not see
/// who carries it; one that looks on from farther away does.
bool is_carried_at(const Extent& extent, const Eigen::Vector3d& place);

/// A place for a camera, in the actor's own frame.
struct Viewpoint {
    Eigen::Vector3d place;  ///< [m]
    double pitch = 0;       ///< [rad] up positive
};

/// Where who drives looks from.
Viewpoint drivers_eye(const VehicleModel& model);

/// Where who walks does.
Viewpoint walkers_eye(const WalkerModel& model);

/// Behind and above, as one follows somebody.
Viewpoint chase(const Extent& extent);

}  // namespace reprise::world
