#pragma once

#include "cli/options/town_options.h"

namespace reprise::cli {

/// Prints the criteria of a good town as a table. Returns 0 when all hold, else 1.
int town_check(const TownCheckOptions& options);

}  // namespace reprise::cli
