#pragma once

#include "world/digest.h"
#include "world/recording.h"

namespace reprise::replay {

/// The chain's value before tick 1: of everything in the recording that decides the run;
/// what branches off does not yet.
world::Digest128 chain_seed(const world::Recording& recording);

}  // namespace reprise::replay
