#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Simulates a trace again from what it carries and compares every tick. Returns 0 or 1.
int verify(const TraceOptions& options);

}  // namespace reprise::cli
