#pragma once

#include <filesystem>

#include "world/external/sensor.h"

namespace reprise::render {

/// Writes a frame as PNG. rgb: 8-bit colour. depth: 16-bit grey, millimetres, 65535 from 65.535 m
/// on and for the sky. semantic: 8-bit grey, class ids. Throws world::Error when it cannot be
/// written.
void write_png(const world::SensorFrame& frame, const std::filesystem::path& path);

/// A version for people: depth near-bright on a logarithmic scale, semantic in CityScapes colours;
/// rgb as it is.
world::SensorFrame viewable(const world::SensorFrame& frame);

}  // namespace reprise::render
