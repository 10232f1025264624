#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Simulates a recorded run again up to a tick and lets other scripts take over there, each in a
/// process of its own. Returns the exit code.
int branch(const BranchOptions& options);

}  // namespace reprise::cli
