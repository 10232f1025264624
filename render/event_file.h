#pragma once

#include <filesystem>

#include "world/external/sensor.h"

namespace reprise::render {

/// Writes the events of a dvs frame. `.csv`: lines x,y,t,pol with t in nanoseconds of the run and
/// pol 1 where light rises. Else an array of numpy with these as fields: uint16, uint16, int64 and
/// bool, as CARLA's. Throws world::Error when it cannot be written.
void write_events(const world::SensorFrame& frame, const std::filesystem::path& path);

}  // namespace reprise::render
