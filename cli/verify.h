#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Simulates a trace again from what it carries and compares every tick, and all else that the file
/// holds. Returns 0 or 1.
int verify(const VerifyOptions& options);

}  // namespace reprise::cli
