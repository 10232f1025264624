#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// `reprise recover`: makes a whole trace of a damaged one and says what was lost. Exit status: 0
/// nothing, 1 all of it, 2 bad input, 3 something.
int recover(const RecoverOptions& options);

}  // namespace reprise::cli
