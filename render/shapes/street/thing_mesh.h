#pragma once

#include <cstdint>

#include "render/shapes/mesh.h"
#include "world/models/prop_models.h"

namespace reprise::render {

/// As a tag: painted as its instance is.
inline constexpr std::uint32_t instance_paint = 0x1000000;

/// A car's open door: a box of one metre each way around the origin, to be stretched.
Mesh door_mesh();

/// A prop of a scenario in its own frame: x along its length, its foot at z = 0. Material::thing,
/// tagged with its paint, 0xRRGGBB as screens show it. Less than 1,500 triangles; without normals.
Mesh thing_mesh(const world::PropModel& model);

}  // namespace reprise::render
