#pragma once

#include <Eigen/Geometry>

#include "world/external/sensor.h"

namespace reprise::world {

/// Of a sensor in the frame that it is mounted in: takes its own frame, x ahead, y left, z up, to
/// its carrier's.
Eigen::Isometry3d pose_in_mount(const SensorSpec& spec);

}  // namespace reprise::world
