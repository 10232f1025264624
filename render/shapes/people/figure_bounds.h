#pragma once

#include <Eigen/Geometry>

#include "world/models/catalogue.h"
#include "world/traffic_generated.h"

namespace reprise::render {

/// Around what is drawn of a walker: limbs at his phase of the walk, clothes, what he carries. In
/// the frame of `figure`, [m]; nothing below the ground. The first call makes all meshes of people.
Eigen::AlignedBox3d figure_bounds(const world::WalkerModel& model,
                                  const world::WalkerState& walker,
                                  bool rains);

}  // namespace reprise::render
