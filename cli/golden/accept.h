#pragma once

#include "cli/options/options.h"

namespace reprise::cli {

/// `reprise accept`: makes what named scenarios do now their goldens, all or none. Exit status: 0
/// written, 1 nothing to accept, 2 bad input, 3 nondeterministic.
int accept(const AcceptOptions& options);

}  // namespace reprise::cli
