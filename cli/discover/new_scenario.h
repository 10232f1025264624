#pragma once

#include "cli/options/discover_options.h"

namespace reprise::cli {

/// Writes a first scenario, which runs and passes as it stands.
int new_scenario(const NewOptions& options);

}  // namespace reprise::cli
