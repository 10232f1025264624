#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"
#include "world/models/building_models.h"

namespace reprise::ground {

/// How high roofs are: what reads a map's heights and what draws them agree through these. [m]

/// What a building's looks are drawn from.
std::uint32_t building_seed(std::uint32_t style);

/// Height of a model's roof over the eaves, on a footprint with these half sizes; 0 when flat.
float roof_rise(const world::BuildingModel& model,
                float half_length,
                float half_width,
                std::uint32_t seed);

/// Half the width of a church's tower; of models with a spire.
float tower_half(float half_width);

/// Tip of a church's spire over the ridge.
float spire_rise(const world::BuildingModel& model, float half_width);

/// Slopes over any convex outline of at most eight corners, all at one pitch that keeps the ridge
/// low: one convex face for each side, counter-clockwise from above, z over the eaves. The outer
/// edge hangs over by `overhang`. Empty when the outline is not convex, or pointed.
std::vector<std::vector<Eigen::Vector3d>> hipped_faces(const world::Loop& outline, double overhang);

/// Highest z of hipped_faces(); 0 without any.
double hipped_rise(const world::Loop& outline);

}  // namespace reprise::ground
