#pragma once

#include "towns/furnish/draws.h"
#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// A tree of that kind there, when its trunk is clear of roads, sidewalks and all that stands, and
/// its crown clear of buildings; over a road the crown begins above lorries. `on_walk`: the caller
/// knows that the sidewalk is wide enough. False: it is not.
bool place_tree(PlacementContext& context,
                world::PlantKind kind,
                const Eigen::Vector2d& foot,
                double road_z,
                Draws& draws,
                bool on_walk = false);

/// A bush; it may touch walls.
bool place_bush(PlacementContext& context,
                world::PlantKind kind,
                const Eigen::Vector2d& foot,
                double road_z,
                Draws& draws);

/// Rows of trees along streets and of poplars along country roads, groups of trees where nothing
/// else stands, and a wood around the town.
void place_street_trees(PlacementContext& context);

}  // namespace reprise::towns
