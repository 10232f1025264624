#pragma once

namespace reprise::traffic {

/// True when SUMO's compiled code gives the bits that this program's own arc tangent gives: then
/// both use one libm. About 10 us.
bool sumo_uses_our_maths();

}  // namespace reprise::traffic
