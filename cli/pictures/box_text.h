#pragma once

#include <string>

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::cli {

/// What a camera saw of whom, as JSON: see docs/rendering.md. `instances` and `classes` are what it
/// saw.
std::string box_text(const world::TickView& tick,
                     const world::SensorSpec& camera,
                     const world::SensorFrame& instances,
                     const world::SensorFrame& classes);

}  // namespace reprise::cli
