#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise slice` and `reprise merge`: cut ticks out of a trace, and join them again.
int slice(const SliceOptions& options);
int merge(const MergeOptions& options);

}  // namespace reprise::cli
