#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise import`: a recording of CARLA's recorder becomes a trace of poses. Returns the exit
/// code: 3 when the log ends early.
int import_log(const ImportOptions& options);

}  // namespace reprise::cli
