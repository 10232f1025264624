#pragma once

namespace reprise::kernel {

/// True when Bullet's compiled code, turning a body, gives the bits that the same formula gives
/// with this program's own sine: then both use one libm. About 20 us.
bool bullet_uses_our_maths();

}  // namespace reprise::kernel
