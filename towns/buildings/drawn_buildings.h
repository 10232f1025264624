#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Sets up the buildings of the place, but for those that reach more than 0.5 m into a lane, or
/// enclose one: then the map is wrong, or the lane. What the map leaves open - model, style - is
/// drawn. Where a footprint is nearly a rectangle of a size that its model can take, the whole
/// model goes into town.buildings (see rectangular_site.h), the first 1500 of them; the rest go
/// into town.drawn_buildings.
void keep_drawn_buildings(PlacementContext& context);

}  // namespace reprise::towns
