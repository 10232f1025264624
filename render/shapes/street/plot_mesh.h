#pragma once

#include <vector>

#include "ground/mesh/ground.h"
#include "render/shapes/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

/// A plot as its look needs it: paths and borders follow the outline. In plan, scene frame.
struct PlotFrame {
    PlotFrame(const world::PlotT& plot, const Eigen::Vector3d& origin);

    /// To the nearest point of the outline. [m]
    float edge_distance(const Eigen::Vector2f& p) const;

    world::PlotKind kind;
    std::vector<Eigen::Vector2f> outline;
    Eigen::Vector2f start;  ///< of the longest side
    Eigen::Vector2f along;  ///< unit vector from there along it, the plot on the left
    float longest;          ///< [m]
};

/// The plots as a cloth over the terrain, 1 cm above it; where two overlap there is the later one
/// only. In world coordinates less `origin`; Material::plot, tagged with the plot's index.
Mesh plot_mesh(const world::TownT& town,
               const ground::GroundMesh& ground,
               const Eigen::Vector3d& origin);

}  // namespace reprise::render
