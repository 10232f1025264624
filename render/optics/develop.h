#pragma once

#include <cstdint>
#include <vector>

#include "render/shade/frame.h"

namespace reprise::render {

/// What becomes of light behind the lens: vignette, exposure, noise, tone curve, 3 bytes a pixel.
/// Of a camera whose attributes say nothing of these the same bytes as tone_map().
std::vector<std::uint8_t> develop(const world::SensorSpec& spec,
                                  const Sky& sky,
                                  std::uint64_t tick,
                                  Frame& frame);

/// Black, unlabeled and unknown where the lens sees nothing.
void blank_unseen(const Camera& camera, world::SensorFrame& frame);

}  // namespace reprise::render
