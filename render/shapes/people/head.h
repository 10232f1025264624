#pragma once

#include "render/shapes/mesh.h"
#include "render/shapes/people/posture.h"

namespace reprise::render {

/// Face, hair and what is worn on them, in the frame of a trunk (see trunk_mesh).
void add_head(Mesh& mesh, const world::WalkerModel& model, const BodyProportions& body);

}  // namespace reprise::render
