#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// Renders pictures of a trace. Returns the exit code.
int render(const RenderOptions& options);

}  // namespace reprise::cli
