#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise stats`: what the vehicles of a trace did, on one screen or as JSON.
int stats(const StatsOptions& options);

}  // namespace reprise::cli
