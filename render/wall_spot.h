#pragma once

#include "render/building_plan.h"
#include "render/look.h"

namespace reprise::render {

/// A place on a wall, and how the view goes on behind it.
struct WallSpot {
    WallSpot(const Wall& of, const BuildingPaint& painted, const Surface& at);

    const Wall& wall;
    const BuildingPaint& paint;
    float u;        ///< [m] from the wall's left end
    float z;        ///< [m] above its foot
    float slope_u;  ///< metres along the wall for each metre of depth
    float slope_z;
    Eigen::Vector3f inwards;  ///< scene
};

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

    bool holds(float u, float z) const;

    /// Distance to the nearest edge, from inside. [m]
    float edge(float u, float z) const;
};

/// The opening whose column and floor this place belongs to.
Opening opening_at(const WallSpot& spot);

/// Colour of a wall between its openings, `u` along it and `z` above the ground. [m]
Color wall_texture(const BuildingPaint& paint, float u, float z, const Surface& at);

/// What is seen in an opening: panes with a room behind them, frames, leaves of doors.
Look opening_look(const Stage& stage, const Surface& at, const WallSpot& spot, const Opening& opening);

}  // namespace reprise::render
