#pragma once

#include "render/look/look.h"
#include "render/shapes/buildings/building_plan.h"
#include "render/shapes/buildings/openings.h"

namespace reprise::render {

/// A place on a wall, and how the view goes on behind it.
struct WallSurfacePoint {
    WallSurfacePoint(const Wall& of, const BuildingPaint& painted, const Surface& at);

    const Wall& wall;
    const BuildingPaint& paint;
    float u;        ///< [m] from the wall's left end
    float z;        ///< [m] above its foot
    float slope_u;  ///< metres along the wall for each metre of depth
    float slope_z;
    Eigen::Vector3f inwards;  ///< scene
};

/// Colour of a wall between its openings, `u` along it and `z` above the ground. [m]
Color wall_texture(const BuildingPaint& paint, float u, float z, const Surface& at);

/// What a part of a building looks like, such as a roof.
Look building_part_look(const Surface& at, const BuildingPaint& paint, BuildingFinish finish);

/// What is seen in an opening: panes with a room behind them, frames, leaves of doors.
Look opening_look(const ShadingInput& input,
                  const Surface& at,
                  const WallSurfacePoint& spot,
                  const Opening& opening);

}  // namespace reprise::render
