#pragma once

#include <span>

#include "towns/buildings/buildings.h"

namespace reprise::towns {

/// What lies around houses: lawns, fences, walls and hedges along the street, bushes before the
/// walls, here and there a driveway with a car; paving before shops and terraces, and car parks
/// behind shops and offices.
void lay_out_gardens(PlacementContext& context, std::span<const StreetBuilding> street_buildings);

}  // namespace reprise::towns
