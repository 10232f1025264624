#pragma once

#include <Eigen/Core>

#include "drivers/control/ego.h"
#include "drivers/way/way.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// Does a car that drives so far [m, negative: backwards] with its front wheels at `steering_angle`
/// [rad, positive: left] come nearer than `clear` [m] to somebody? Who it drives away from is not
/// in its way, however near they are now. O(actors).
bool comes_near(const world::TickView& last,
                const Ego& ego,
                double distance,
                double steering_angle,
                double clear);

/// Is a vehicle on its way around at this place of a lane that drives off at `yaw` [rad], so that
/// it stands across? O(vehicles).
bool turns_around_at(const world::TickView& last,
                     const Ego& ego,
                     const Eigen::Vector2d& place,
                     double yaw);

/// Does somebody long turn, over the junction behind the gate, into the street that we come from? A
/// bus or a lorry needs more than its lane for that, and most of all the place of who waits at the
/// line. `self`: who asks.
bool turns_in_beside(const world::TickView& last,
                     const world::TownT& town,
                     const Gate& gate,
                     std::uint32_t self);

}  // namespace reprise::drivers
