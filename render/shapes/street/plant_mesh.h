#pragma once

#include <cstdint>

#include "render/shapes/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

inline constexpr std::uint32_t tree_kinds = 6;

/// A tree of any kind, of height 1 and crown radius 1, to be stretched. About 3,000 triangles.
Mesh tree_mesh(std::uint32_t kind);

/// A plant of a kind, likewise. Less than 10,500 triangles, shared by all plants of the kind.
Mesh plant_mesh(world::PlantKind kind);

}  // namespace reprise::render
