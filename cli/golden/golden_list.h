#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// `reprise golden list`: each golden, its scenario and its reason. Exit status: 1 when --orphans
/// found some, 2 when a golden cannot be read.
int golden_list(const GoldenListOptions& options);

}  // namespace reprise::cli
