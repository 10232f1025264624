#pragma once

#include "cli/options/serve_options.h"

namespace reprise::cli {

/// `reprise serve`: accepts clients, each of which gets a process of its own that ends with us.
int serve(const ServeOptions& options);

}  // namespace reprise::cli
