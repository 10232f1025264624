#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Simulates a stripped trace again, compares every tick with what it holds, and writes the full
/// trace. Returns 0, or 1 and writes nothing when a tick differs.
int expand(const ExpandOptions& options);

}  // namespace reprise::cli
