#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Prints the first difference of two traces. Returns 0 when equal, 1 when not.
int diff(const DiffOptions& options);

}  // namespace reprise::cli
