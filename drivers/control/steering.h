#pragma once

#include <optional>

#include "drivers/control/ego.h"
#include "drivers/control/lateral_order.h"
#include "drivers/control/wide_turn.h"
#include "drivers/way/path.h"

namespace reprise::drivers {

/// The steering wheel, [-1, 1], that keeps the car on its path; a pure function of what is seen.
///
/// Stanley's law (Thrun et al., "Stanley: The Robot that Won the DARPA Grand Challenge", J. Field
/// Robotics 23 (2006), 661; yaw damping from Hoffmann et al., ACC 2007), with the path's curvature
/// fed forward and with the tracked point between the axles instead of on the front one: in a
/// corner of 6 m the rear axle of a sedan runs 0.7 m inside the front axle's track, and a lane has
/// no room for all of that on one side. `beside`: where it is to drive beside the path, at
/// `tracked_ahead` of the rear axle; who is told that knows what tyres slip, too.
double steer(const Ego& ego,
             const Path& path,
             const std::optional<BesidePath>& beside = std::nullopt);

/// As above, for a long vehicle: it tracks the plan of its rear axle.
double steer(const Ego& ego,
             const WideTurnPlan& wide_turn,
             const std::optional<BesidePath>& beside = std::nullopt);

/// [m] of the rear axle: what is kept on the path.
double tracked_ahead(const world::VehicleModel& model);

}  // namespace reprise::drivers
