#pragma once

#include "world/models/car_model.h"
#include "world/tick_generated.h"

namespace reprise::world {

/// The least time in which such a vehicle can move so far aside while it drives on. [s]; distance
/// in m, speed in m/s; infinity where it stands. Half of the tyres' grip, what the wheels can be
/// turned, and 30 degrees to the road; a linear change, which has corners, within 0.15 m.
double quickest_shift(
    const CarModel& car, double distance, Shape shape, double speed, double road_friction);

/// What the brakes and the road give on the flat. [m/s^2]
double hardest_braking(const CarModel& car, double road_friction);

/// What the engine and the road give at this speed, on the flat. [m/s^2]; may be below 0.
double hardest_accelerating(const CarModel& car, double speed, double road_friction);

}  // namespace reprise::world
