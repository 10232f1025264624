#pragma once

#include <vector>

#include "render/shapes/mesh.h"
#include "render/shapes/people/figure_part.h"
#include "render/shapes/people/posture.h"
#include "render/shapes/people/wardrobe.h"

namespace reprise::render {

/// Moves the hands to where they hold what is carried.
void hold(Posture& posture, const BodyProportions& body, const world::Carried& carried, bool rains);

/// The things themselves. The posture must be one that holds them.
void add_carried(std::vector<FigurePart>& parts,
                 const Posture& posture,
                 const BodyProportions& body,
                 const world::Carried& carried,
                 bool rains);

/// The mesh of a thing, in metres. Frame: what hangs hangs from the origin, what stands on the
/// ground or on a back has its x ahead.
Mesh thing_mesh(FigurePart::Shape shape);

}  // namespace reprise::render
