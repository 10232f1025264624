#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise query`: SQL over a trace.
int query(const QueryOptions& options);

}  // namespace reprise::cli
