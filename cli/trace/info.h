#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Prints what a trace holds, on one screen. Returns the exit code.
int info(const InfoOptions& options);

}  // namespace reprise::cli
