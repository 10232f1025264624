#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "world/models/catalogue.h"
#include "world/traffic_generated.h"

namespace reprise::render {

/// Around what is drawn of a walker: limbs at his phase of the walk, clothes, what he carries. In
/// the frame of `figure`, [m]; nothing below the ground. The first call makes all meshes of people.
Eigen::AlignedBox3d figure_bounds(const world::WalkerModel& model,
                                  const world::WalkerState& walker,
                                  bool rains);

/// Around a two-wheeler of the catalogue and who rides it, wherever the pedals are and whatever he
/// wears, in its own frame. [m] Arms and helmets reach out of the box that others bump into. The
/// first call for any model makes all of them.
const Eigen::AlignedBox3d& ridden_bounds(std::uint16_t model);

}  // namespace reprise::render
