#pragma once

#include "world/common_generated.h"

namespace reprise::world {

/// A weather on the way from one to another: each physical number goes evenly, those that say where
/// something is the shorter way round. `share` in [0, 1]: its ends are the two weathers exactly.
Weather mixed(const Weather& from, const Weather& to, double share);

}  // namespace reprise::world
