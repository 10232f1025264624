#pragma once

#include <string>
#include <vector>

#include "replay/golden/golden.h"

namespace reprise::replay {

/// What a golden compares, as its author names it:
///   "verdict"  how the run and each check ended; always compared
///   "events"   what happened, with whom and in which tick, and how long the run was
///   a name     where that actor was, at each instant that the golden keeps states of
/// Without a pin everything is compared: all stages in every tick, and every digit.
/// Takes everything else out of a golden, so that it is neither kept nor compared.
void keep_pinned(Golden& golden);

/// Throws world::Error for a pin that names nobody whom the run has at such an instant.
void check_pins(const Golden& golden);

}  // namespace reprise::replay
