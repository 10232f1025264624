#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Signs beside the roads, into town.props. Those that the place knows are kept. Where it knows no
/// speed-limit signs at all, they are derived: at the start of every road that is entered from one
/// with another limit. Likewise stop and yield signs: at every road that must give way to vehicles
/// at a junction without lights. Crossing signs stand at crossings without lights where no such
/// sign makes drivers give way already. No derived sign hides another.
void place_signs(PlacementContext& context);

}  // namespace reprise::towns
