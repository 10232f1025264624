#pragma once

#include "ground/mesh/ground.h"

namespace reprise::ground {

/// Banks of earth (Surface::terrain) from the edges of roads and sidewalks down to terrain that
/// lies lower, where no deck is: for eyes only, wheels roll over what `ground` holds. None in a
/// flat town. A pure function of the ground.
GroundMesh build_banks(const GroundMesh& ground);

}  // namespace reprise::ground
