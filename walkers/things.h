#pragma once

#include "walkers/neighbours.h"
#include "walkers/places.h"
#include "world/tick.h"

namespace reprise::walkers {

/// What drives, stands or lies where people go, as round bodies in a row along each: SUMO's cars
/// as `next` has them, vehicles with mass, props and open doors as `last` had them. Whoever is on
/// the road keeps away from what drives; everybody goes around what stands for good: parked cars,
/// wrecks, props and doors. Of SUMO's cars that drive only those near somebody on the road are
/// added, of those that stand those near anybody: `on_road` and `people`, where these are. `step`
/// [s] of a tick.
void add_things(const world::TickView& last,
                const world::TickDraft& next,
                double step,
                const Places& on_road,
                const Places& people,
                Neighbours& neighbours);

}  // namespace reprise::walkers
