#pragma once

#include <cstdint>

#include "towns/buildings/rectangular_site.h"
#include "towns/maps/map_area.h"

namespace reprise::towns {

/// What a map's tags make of a footprint: model, style and the height of its eaves. Of the models
/// that suit the tags one that the footprint can take; the ridge (or the tip of a spire) is as high
/// as the map says. `draw` decides where the map does not.
world::DrawnBuildingT mapped_building(const Tags& tags,
                                      const std::vector<world::Vec3>& outline,
                                      const Streets& streets,
                                      std::uint64_t draw);

}  // namespace reprise::towns
