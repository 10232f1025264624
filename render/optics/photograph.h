#pragma once

#include <vector>

#include "render/optics/shutter.h"
#include "render/optics/stage.h"
#include "render/shade/frame.h"

namespace reprise::render {

/// Shades a picture that takes time, or that is not sharp everywhere, into frame.colors: the mean
/// of what each row's samples saw. `work` is memory.
void gather_light(Stage& stage,
                  const Sight& sight,
                  const Shutter& shutter,
                  const std::vector<Band>& bands,
                  const ShadingInput& input,
                  Frame& work,
                  Frame& frame);

}  // namespace reprise::render
