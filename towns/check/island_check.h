#pragma once

#include "ground/mesh/ground_probe.h"
#include "towns/check/criterion.h"

namespace reprise::towns {

/// Are all pieces of sidewalk large enough to walk or to wait on? Counts islands that are splinters
/// (splinters.h), such as cars would meet between their paths. Looks at the triangles alone.
/// `probe` is one of `ground`.
Criterion check_islands(const ground::GroundMesh& ground, const ground::GroundProbe& probe);

}  // namespace reprise::towns
