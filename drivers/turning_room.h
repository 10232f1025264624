#pragma once

#include <Eigen/Core>

#include "drivers/control/ego.h"
#include "world/tick.h"

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

}  // namespace reprise::drivers
