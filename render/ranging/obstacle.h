#pragma once

#include "render/scene/scene.h"
#include "world/external/sensor.h"

namespace reprise::render {

/// The nearest thing in a tube along the sensor's x axis at a tick: one row, or none; see
/// world/external/point_fields.h. Places the scene at the tick. Throws world::Error when the
/// sensor's actor is not there.
world::SensorFrame obstacle_frame(Scene& scene,
                                  const world::TickView& tick,
                                  const world::SensorSpec& spec);

}  // namespace reprise::render
