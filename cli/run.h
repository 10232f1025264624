#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Runs a scenario and records it. Returns 0 when every check passed, 1 when one failed.
int run(const RunOptions& options);

}  // namespace reprise::cli
