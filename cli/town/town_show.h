#pragma once

#include "cli/options/town_options.h"

namespace reprise::cli {

/// Draws a town as seen from above. Returns the exit code.
int town_show(const TownShowOptions& options);

}  // namespace reprise::cli
