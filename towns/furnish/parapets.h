#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// Low walls along roads where another road passes below, and some metres before and behind.
void place_parapets(PlacementContext& context);

}  // namespace reprise::towns
