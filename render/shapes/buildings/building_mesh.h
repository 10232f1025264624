#pragma once

#include <cstdint>

#include "render/shapes/buildings/building_plan.h"
#include "render/shapes/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

/// How the faces of a building without a model are divided; mesh and texture agree through it. [m]
struct Facade {
    explicit Facade(const world::Building& building);

    world::FacadeKind kind;
    bool gabled;         ///< a saddle roof along the length, else flat behind a parapet
    float eaves;         ///< height of the walls; a gabled roof rises above
    float ground_floor;  ///< height of the ground floor
    float floor_height;  ///< of those above
    int floors;          ///< above the ground floor
    std::uint32_t seed;

    /// Bays side by side on a wall of this length.
    int bays(float wall) const;
};

/// Appends a building without a model in world coordinates less `origin`; tags are `index`.
void add_building(Mesh& mesh,
                  const world::Building& building,
                  std::uint32_t index,
                  const Eigen::Vector3d& origin);

/// Appends a building with a model, 100 to 6,000 triangles, and what its faces look like.
void add_model_building(Mesh& mesh,
                        Facades& facades,
                        const world::Building& building,
                        const Eigen::Vector3d& origin);

/// Appends walls over an outline, and a roof: with four slopes over simple houses, else flat.
void add_drawn_building(Mesh& mesh,
                        Facades& facades,
                        const world::DrawnBuildingT& building,
                        const Eigen::Vector3d& origin);

}  // namespace reprise::render
