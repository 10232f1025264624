#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene/scene.h"
#include "render/trace/camera.h"

namespace reprise::render {

/// The same place at two ticks: who was where, and from where the camera looked.
struct OtherTick {
    const Scene& scene;
    Camera camera;
};

/// How far each pixel's surface is in this picture from where it is in that of the other tick [px]:
/// two floats, to the right and down. With `forward` the way from this picture to the other's, else
/// from the other's to this one: both point as things move, where the other tick is the next, or
/// the last. What moves is followed part by part, wheels and limbs as well. Quiet NaN where the
/// surface was not in the world at the other tick, or is behind the camera; everywhere without one.
std::vector<std::uint8_t> flow_bytes(const Scene& scene,
                                     const Camera& camera,
                                     const std::vector<Hit>& hits,
                                     const OtherTick* other,
                                     bool forward);

}  // namespace reprise::render
