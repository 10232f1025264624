#pragma once

#include <cstdint>
#include <filesystem>

#include "world/external/sensor.h"

namespace reprise::render {

/// What is in a picture, for how it is packed best.
enum class Texture : std::uint8_t {
    grainy,  ///< as rgb frames, whose noise repeats nothing
    flat     ///< drawn: areas of one colour
};

/// Writes a frame as PNG. rgb: 8-bit colour. depth: 16-bit grey, millimetres, 65535 from 65.535 m
/// on and for the sky. semantic: 8-bit grey, class ids. `texture` is of colours. Throws
/// world::Error when it cannot be written. An rgb frame of 800x600: 20 ms.
void write_png(const world::SensorFrame& frame,
               const std::filesystem::path& path,
               Texture texture = Texture::grainy);

/// A version for people: depth near-bright on a logarithmic scale, semantic in CityScapes colours;
/// rgb as it is.
world::SensorFrame viewable(const world::SensorFrame& frame);

}  // namespace reprise::render
