#pragma once

#include "towns/furnish/land.h"

namespace reprise::towns {

/// Low walls along roads where another road passes below, and some metres before and behind.
void place_parapets(Land& land);

}  // namespace reprise::towns
