#pragma once

#include <Eigen/Geometry>

#include "world/models/catalogue.h"

namespace reprise::kernel {

class Ground;

/// A vehicle at rest on its wheels at this place: the origin exactly above (x, y), height, pitch
/// and roll of the ground under the four wheels. `p_world.z` says on which level: ground up to 1.5
/// m above it is looked for first, then the nearest below, then any. Frame: the vehicle's.
Eigen::Isometry3d stance(const Ground& ground,
                         const world::VehicleModel& model,
                         const Eigen::Vector3d& p_world,
                         double yaw);

}  // namespace reprise::kernel
