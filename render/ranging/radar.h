#pragma once

#include "render/scene/scene.h"
#include "world/external/sensor.h"

namespace reprise::render {

/// What a radar detected at a tick, the strongest first; rows as world/external/point_fields.h
/// says. Places the scene at the tick. Throws world::Error when the sensor's actor is not there.
world::SensorFrame radar_frame(Scene& scene,
                               const world::TickView& tick,
                               const world::SensorSpec& spec,
                               const world::Weather& weather);

}  // namespace reprise::render
