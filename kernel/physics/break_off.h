#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/physics/collisions.h"
#include "kernel/physics/near_obstacles.h"
#include "kernel/physics/props.h"
#include "kernel/physics/vehicle.h"

namespace reprise::kernel {

/// Before a substep of that many seconds: thin poles that a vehicle is about to hit harder than
/// they bear break off. The foot takes `breaks_at` of the vehicle's momentum, the pole is a prop
/// from then on (world::first_broken_id), and Bullet says what becomes of it. Appends their ids.
void break_off(NearObstacles& obstacles,
               const std::vector<std::unique_ptr<Vehicle>>& vehicles,
               double substep,
               Props& props,
               Collisions& collisions,
               std::vector<std::uint32_t>& broken);

}  // namespace reprise::kernel
