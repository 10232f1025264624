#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// `reprise test`: runs scenarios and compares them with their goldens; where another program
/// drives, its checks count. Exit status: 0 all equal, 1 something changed, failed, was not run or
/// lacks its golden, 2 bad input or a run that broke, 3 nondeterministic.
int test(const TestOptions& options);

}  // namespace reprise::cli
