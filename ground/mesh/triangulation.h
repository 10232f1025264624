#pragma once

#include <array>
#include <vector>

#include "world/geometry2d.h"

namespace reprise::ground {

/// Triangles that cover what lies inside of these borders (outer ones and holes, either way round),
/// counter-clockwise. Their corners are the borders' own, so that triangles meet without cracks;
/// constrained Delaunay, so that they are as little pointed as may be. Borders may touch, and must
/// not cross. Exact for coordinates that are whole numbers: the same on every machine.
std::vector<std::array<Eigen::Vector2d, 3>> triangulate(const std::vector<world::Loop>& borders);

}  // namespace reprise::ground
