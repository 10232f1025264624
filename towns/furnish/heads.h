#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Fills town.heads: a lamp housing for the signals that one lane faces, two for those of a
/// crossing. Poses that the place knows are kept, where the pole does not stand on a road; others
/// are derived: a pole beside the kerb with the housing of the outermost lane, and those of inner
/// lanes on arms over the road.
void place_heads(PlacementContext& context);

}  // namespace reprise::towns
