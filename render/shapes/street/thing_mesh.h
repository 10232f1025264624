#pragma once

#include <cstdint>

#include "render/shapes/mesh.h"
#include "world/models/prop_models.h"

namespace reprise::render {

/// A prop of a scenario in its own frame: x along its length, its foot at z = 0. Material::thing,
/// tagged with its paint, 0xRRGGBB as screens show it. Less than 1,500 triangles; without normals.
Mesh thing_mesh(const world::PropModel& model);

}  // namespace reprise::render
