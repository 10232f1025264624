#pragma once

#include "ground/mesh/ground.h"
#include "world/external/sensor.h"
#include "world/geometry2d.h"

namespace reprise::render {

/// Roads and sidewalks seen from above, north up: 255 where one may drive or walk, 0 elsewhere, a
/// byte a pixel. Pixel (column, row) is the place region.low.x + column * pixel, region.low.y +
/// (rows - row) * pixel, as nuScenes' masks have it. A frame of kind semantic.
world::SensorFrame road_mask(const ground::GroundMesh& ground,
                             const world::Box& region,
                             double pixel);

}  // namespace reprise::render
