#pragma once

#include <span>
#include <string>

#include "render/labels/boxes.h"
#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::cli {

/// What a camera saw of whom, as JSON: see docs/rendering.md. `instances` and `classes` are what it
/// saw, `parked` stand in the town.
std::string box_text(const world::TickView& tick,
                     std::span<const render::ParkedVehicle> parked,
                     const world::SensorSpec& camera,
                     const world::SensorFrame& instances,
                     const world::SensorFrame& classes);

}  // namespace reprise::cli
