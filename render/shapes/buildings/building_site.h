#pragma once

#include "render/shapes/builder.h"
#include "render/shapes/buildings/building_plan.h"

namespace reprise::render {

/// A building under construction: what its roof, walls and parts are added to.
struct BuildingSite {
    Builder build;
    const BuildingPlan& plan;
    std::vector<Wall>& walls;
    std::uint32_t paint;  ///< index in Facades.buildings
    const BuildingPaint& painted;
    std::size_t first_wall;  ///< of this building, in `walls`

    Finish finish(BuildingFinish of) const {
        return {Material::building, building_finishes * paint + static_cast<std::uint32_t>(of)};
    }

    /// An upright face; `left` and `right` are its lower corners for who looks at it, at one
    /// height, in the building's frame. At the ground it reaches below it, where a slope may lie.
    void wall(const Eigen::Vector3f& left, const Eigen::Vector3f& right, float top, WallUse use);

    /// Four upright faces around a box, the front at -y.
    void walls_around(const Eigen::Vector3f& low,
                      const Eigen::Vector3f& high,
                      WallUse front,
                      WallUse others);
};

/// The roof over the walls, with gables.
void add_roof(BuildingSite& site);

/// A roof with four slopes over a rectangle at this height, its ridge along the longer side.
void add_hipped_roof(BuildingSite& site,
                     const Eigen::Vector3f& middle,
                     const Eigen::Vector2f& half,
                     float rise);

/// A roof with two slopes over a rectangle at this height, its ridge along x, and two gables.
void add_gabled_roof(BuildingSite& site,
                     const Eigen::Vector3f& middle,
                     const Eigen::Vector2f& half,
                     float rise);

/// A flat roof inside the walls' upper end, which stands around it as a parapet.
void add_flat_roof(BuildingSite& site, const Eigen::Vector2f& half, float top);

/// A drum with a dome and a lantern over a flat roof.
void add_dome(BuildingSite& site);

/// A nave under a steep roof with a tower at its west end.
void add_church(BuildingSite& site);

/// What is on the roof: chimneys, dormers, machines, turrets.
void add_roof_parts(BuildingSite& site);

/// Sills under the windows, gutters and downpipes.
void add_details(BuildingSite& site);

/// What is before the front: balconies, bays, porches, shop signs, awnings, fire escapes.
void add_front_parts(BuildingSite& site);

}  // namespace reprise::render
