#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "render/mesh.h"
#include "world/catalogue.h"
#include "world/traffic_generated.h"

namespace reprise::render {

/// A piece of a walker: a unit shape, stretched and placed.
struct Limb {
    enum class Shape : std::uint8_t { ball, bone };
    Shape shape;
    Material material;
    Eigen::Affine3d pose;  ///< from the unit shape's frame to the walker's frame
};

/// Radius 1 around the origin.
Mesh ball_mesh();

/// From (0, 0, 0) to (0, 0, 1), round ends, radius 1 at the start and 0.72 at the end.
Mesh bone_mesh();

/// The limbs of a walker at his phase of the walk, x ahead, on the ground between his feet. Angles
/// of hip and knee after Winter, "Biomechanics and Motor Control of Human Movement", as two
/// harmonics; feet do not slide because the phase comes from the distance walked.
std::vector<Limb> figure(const world::WalkerModel& model, const world::WalkerState& walker);

}  // namespace reprise::render
