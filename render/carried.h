#pragma once

#include <vector>

#include "render/limb.h"
#include "render/mesh.h"
#include "render/posture.h"
#include "render/wardrobe.h"

namespace reprise::render {

/// Moves the hands to where they hold what is carried.
void hold(Posture& posture, const Build& build, const Carried& carried, bool rains);

/// The things themselves. The posture must be one that holds them.
void add_carried(std::vector<Limb>& limbs,
                 const Posture& posture,
                 const Build& build,
                 const Carried& carried,
                 bool rains);

/// The mesh of a thing, in metres. Frame: what hangs hangs from the origin, what stands on the
/// ground or on a back has its x ahead.
Mesh thing_mesh(Limb::Shape shape);

}  // namespace reprise::render
