#pragma once

#include "render/shapes/buildings/building_plan.h"

namespace reprise::render {

enum class OpeningKind : std::uint8_t { none, window, shop, door, shop_door, gate };

/// A window, door or gate of a wall, in its coordinates.
struct Opening {
    OpeningKind kind = OpeningKind::none;
    float left = 0;
    float right = 0;
    float low = 0;
    float high = 0;  ///< of a round head: its crown
    bool arched = false;
    std::uint32_t seed = 0;

    bool contains(float u, float z) const;

    /// Distance to the nearest edge, from inside. [m]
    float edge(float u, float z) const;
};

/// The opening of the column and floor that a place belongs to, `u` and `z` as those of a
/// WallSurfacePoint.
Opening opening_at(const Wall& wall, const BuildingPaint& paint, float u, float z);

}  // namespace reprise::render
