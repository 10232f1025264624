#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Writes a trace again with less of each tick. Returns the exit code.
int strip(const StripOptions& options);

}  // namespace reprise::cli
