#pragma once

#include <span>

#include "walkers/neighbours.h"
#include "walkers/places.h"
#include "walkers/road_users.h"
#include "world/tick.h"

namespace reprise::walkers {

/// What drives, stands or lies where people go, as round bodies in a row along each: `users`, and
/// props and open doors as `last` has them. Whoever is on the road keeps away from what drives;
/// everybody goes around what stands for good: parked cars, wrecks, props and doors. Of those that
/// drive only who is near somebody on the road is added, of those that stand who is near anybody:
/// `on_road` and `people`, where these are.
void add_things(const world::TickView& last,
                std::span<const RoadUser> users,
                const Places& on_road,
                const Places& people,
                Neighbours& neighbours);

}  // namespace reprise::walkers
