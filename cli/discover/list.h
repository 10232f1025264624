#pragma once

#include "cli/options/discover_options.h"

namespace reprise::cli {

/// Prints what a scenario can name: models, weathers, words, towns, lanes, ...
int list(const ListOptions& options);

}  // namespace reprise::cli
