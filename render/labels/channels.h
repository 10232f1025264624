#pragma once

#include <cstdint>
#include <vector>

#include "render/look/look.h"

namespace reprise::render {

// The bytes of a frame, from what each pixel's ray met: see world::SensorFrame. None depends on
// light or weather.

/// [m] along the optical axis; infinity for the sky.
std::vector<std::uint8_t> depth_bytes(const std::vector<Hit>& hits);

std::vector<std::uint8_t> class_bytes(const Scene& scene, const std::vector<Hit>& hits);

/// Numbers of world/external/instance_id.h.
std::vector<std::uint8_t> instance_bytes(const Scene& scene, const std::vector<Hit>& hits);

/// In the camera's frame: x right, y down, z ahead.
std::vector<std::uint8_t> normal_bytes(const Scene& scene,
                                       const Camera& camera,
                                       const std::vector<Hit>& hits);

/// The number of what was hit.
std::uint16_t instance_number(const Scene& scene, const Hit& hit);

}  // namespace reprise::render
