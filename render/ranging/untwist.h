#pragma once

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::render {

/// Points of a rolling sweep lie in the sensor's frame of their own shots. This takes the sensor's
/// own way back: they then lie in its frame at the tick, as calibrations say it. What others moved
/// meanwhile stays in. `spec`: the sensor in its place. Leaves all other frames alone.
void untwist(world::SensorFrame& frame, const world::TickView& tick, const world::SensorSpec& spec);

}  // namespace reprise::render
