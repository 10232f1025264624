#pragma once

#include <cstdint>

#include "render/mesh.h"
#include "world/town_generated.h"

namespace reprise::render {

/// The town's box-shaped buildings have one of these faces, by their style.
enum class FacadeKind : std::uint8_t { brick, plaster, stone, office, glass };

/// How a building's faces are divided; mesh and texture agree through it. [m]
struct Facade {
    explicit Facade(const world::Building& building);

    FacadeKind kind;
    bool gabled;         ///< a saddle roof along the length, else flat behind a parapet
    float eaves;         ///< height of the walls; a gabled roof rises above
    float ground_floor;  ///< height of the ground floor
    float floor_height;  ///< of those above
    int floors;          ///< above the ground floor
    std::uint32_t seed;

    /// Bays side by side on a wall of this length.
    int bays(float wall) const;
};

/// Appends a building in world coordinates less `origin`; tags are `index`.
void add_building(Mesh& mesh,
                  const world::Building& building,
                  std::uint32_t index,
                  const Eigen::Vector3d& origin);

/// Appends poles and heads of every signal, in world coordinates less `origin`.
void add_signals(Mesh& mesh, const world::TownT& town, const Eigen::Vector3d& origin);

inline constexpr std::uint32_t tree_kinds = 6;

/// A tree of height 1 and crown radius 1, to be stretched. About 3,000 triangles.
Mesh tree_mesh(std::uint32_t kind);

}  // namespace reprise::render
