#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise score`: infractions, kilometres between them, route completion, driving scores.
int score(const ScoreOptions& options);

}  // namespace reprise::cli
