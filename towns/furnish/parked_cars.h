#pragma once

#include <cstdint>

#include "towns/furnish/draws.h"
#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// A car of the catalogue that people park: its index in world::vehicle_models().
std::uint16_t choose_parked_model(Draws& draws);

/// A parked car there, where it is clear. `yaw`: the way it points. False: it is not.
bool park(PlacementContext& context,
          const Eigen::Vector2d& middle,
          double yaw,
          double road_z,
          Draws& draws);

/// Rows of cars on a car park, as its shape allows: bays of 2.5 m along its longest side.
void fill_car_park(PlacementContext& context,
                   const world::Loop& outline,
                   double road_z,
                   Draws& draws);

/// Cars along the kerbs of lanes so wide that a path of 2.5 m stays free beside them.
void park_along_wide_lanes(PlacementContext& context);

}  // namespace reprise::towns
