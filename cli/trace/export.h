#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise export`: a trace in the formats of other programs.
int export_trace(const ExportOptions& options);

}  // namespace reprise::cli
