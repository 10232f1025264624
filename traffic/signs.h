#pragma once

#include "traffic/land.h"

namespace reprise::traffic {

/// Signs beside the roads, into town.props. Those that the place knows are kept. Where it knows no
/// speed-limit signs at all, they are derived: at the start of a road whose limit differs from that
/// of the road straight before it. Likewise stop and yield signs: at every road that must give way
/// to vehicles at a junction without lights. Crossing signs stand at crossings
/// without lights.
void place_signs(Land& land);

}  // namespace reprise::traffic
