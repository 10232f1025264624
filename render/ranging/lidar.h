#pragma once

#include "render/scene/scene.h"
#include "world/external/sensor.h"

namespace reprise::render {

/// What a lidar or a semantic_lidar measured at a tick; rows as world/external/point_fields.h says.
/// Places the scene anew for each 10 ms of the sweep, and leaves it so. 64 x 2048 shots: 22 ms of a
/// core. Throws world::Error when the sensor's actor is not in the tick.
world::SensorFrame lidar_frame(Scene& scene,
                               const world::TickView& tick,
                               const world::SensorSpec& spec,
                               const world::Weather& weather);

}  // namespace reprise::render
