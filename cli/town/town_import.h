#pragma once

#include "cli/options/town_options.h"

namespace reprise::cli {

/// Makes a town's folder of a map, and prints what was done. Returns the exit code.
int town_import(const TownImportOptions& options);

}  // namespace reprise::cli
