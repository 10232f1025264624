#pragma once

#include "world/common_generated.h"

namespace reprise::world {

/// What is left of contrast at the meteorological range is 5 % (WMO), and ln 20 is nearly 3.
inline constexpr double range_by_extinction = 3;

/// Extinction by falling drops. [1/m]; rain in mm/h. Marshall and Palmer's sizes (1948), each drop
/// taking twice its section: (pi/4) 2 8000 2 / (4.1 R^-.21)^3 1e-6. Within 3 % of Weber et al.
/// (2015) above 25 mm/h. Drops are large against the waves: light and lidar alike.
double rain_extinction(double rain);

/// Extinction by falling flakes. [1/m]; snow in mm/h of water. One mm/h lets one see about a
/// kilometre (Rasmussen et al., "The Estimation of Snowfall Rate Using Visibility", 1999).
double snow_extinction(double snow);

/// Of the fog at this height above the town's lowest ground: as said up to its base, thinning
/// above. [1/m]
double fog_extinction_at(const Weather& weather, double height);

/// Fog between two heights as a mean along a straight way: what optical depth is per metre. [1/m]
double mean_fog_extinction(const Weather& weather, double from_height, double to_height);

/// Of all that does not depend on height: rain, snow, dust. [1/m]
double even_extinction(const Weather& weather);

inline constexpr double film_mm_when_wet = 0.5;    ///< [mm] of water on a road of wetness 1
inline constexpr double deepest_puddle_mm = 10.0;  ///< [mm] in the lowest spots of puddles = 1

}  // namespace reprise::world
