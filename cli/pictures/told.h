#pragma once

#include <span>

#include "world/external/sensor.h"

namespace reprise::cli {

/// Tells a sensor what `--attribute` said, as far as its kind knows it. Throws world::Error for
/// what is not possible.
void tell(world::SensorSpec& sensor, std::span<const world::AttributeValue> said);

}  // namespace reprise::cli
