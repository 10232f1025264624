#pragma once

#include "cli/options/discover_options.h"

namespace reprise::cli {

/// Reads scenarios and tries them, records nothing, prints what is wrong with them.
/// 0: nothing; 2: something.
int lint(const LintOptions& options);

}  // namespace reprise::cli
