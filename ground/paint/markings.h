#pragma once

#include "ground/mesh/ground.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// Painted lines of the town (Surface::marking). Derived, because road networks do not hold them:
/// dashes between lanes of one direction; between directions a centre line, dashed in towns and
/// solid near junctions, in bends and on fast or wide roads; edge lines where there is no kerb;
/// stop lines at signals and stop signs, shark's teeth where one must give way; arrows where lanes
/// lead to different turns; zebra stripes.
GroundMesh build_markings(const world::TownT& town);

}  // namespace reprise::ground
