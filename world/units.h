#pragma once

#include <limits>
#include <numbers>

namespace reprise::world {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// [rad] in one degree.
inline constexpr double degree = std::numbers::pi / 180;

/// [m] Surfaces of roads and sidewalks that are farther apart in height belong to different levels:
/// a bridge and what it passes over. Half of the 4.5 m that lorries need between them.
inline constexpr double level_spacing = 2.5;

/// [m] The same for what a driver counts with: bodies and things reach up from their road.
inline constexpr double level_clearance = 3;

}  // namespace reprise::world
