#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "render/shapes/material.h"

namespace reprise::render {

/// A part of a walker or rider, or a thing that he carries: a shared mesh, stretched and placed.
struct FigurePart {
    enum class Shape : std::uint8_t {
        trunk,  ///< of the model, as the hem
        hem,
        ball,
        bone,
        shoe,
        phone,
        shopping_bag,
        guitar_case,
        suitcase,
        rolling_bag,
        open_umbrella,
        closed_umbrella,
        backpack
    };
    Shape shape;
    Material material;     ///< of what the mesh leaves open
    Eigen::Affine3d pose;  ///< from the mesh's frame to the walker's
};

inline constexpr std::size_t figure_part_shapes = 13;

}  // namespace reprise::render
