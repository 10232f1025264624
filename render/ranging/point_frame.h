#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::render {

/// What a sensor that measures points or detections found at a tick: rows of the 32-bit columns
/// that world::point_fields says, one row of `words` behind the other.
world::SensorFrame point_frame(const world::TickView& tick,
                               const world::SensorSpec& spec,
                               std::span<const std::uint32_t> words);

/// Likewise of several pieces, one behind the other.
world::SensorFrame joined_point_frame(const world::TickView& tick,
                                      const world::SensorSpec& spec,
                                      std::span<const std::vector<std::uint32_t>> pieces);

}  // namespace reprise::render
