#pragma once

#include "render/shapes/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

/// Grass from below the town to the horizon, in the scene's frame: level as far as the town
/// reaches, hills beyond. A function of the place in the world alone.
Mesh land_mesh(const world::TownT& town, const Eigen::Vector3d& origin);

}  // namespace reprise::render
