#pragma once

#include "traffic/land.h"

namespace reprise::traffic {

/// Fills town.drawn_buildings with those of the place, but for those that reach more than 0.5 m
/// into a lane: then the map is wrong, or the lane. What the map leaves open - model, style - is
/// drawn.
void keep_drawn_buildings(Land& land);

}  // namespace reprise::traffic
