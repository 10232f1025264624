#pragma once

#include <vector>

#include "towns/bridges/levels.h"
#include "towns/bridges/road_chains.h"

namespace reprise::towns {

/// Between the road surfaces of one level and the next: 4.5 m for lorries, 1.5 m for a deck. [m]
inline constexpr double level_height = 6.0;

/// A height for each point of a road network. [m] Points with a level have its height; the others
/// climb between them by about 8 % at most, or evenly where there is no room for that, without
/// kinks. Far from every bridge and tunnel heights are 0.
std::vector<double> find_heights(const RoadChains& roads, const Levels& levels);

}  // namespace reprise::towns
