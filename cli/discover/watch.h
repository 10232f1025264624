#pragma once

#include "cli/options/run_options.h"

namespace reprise::cli {

/// Runs the scenario in a process of its own, with the same command line, and again whenever it or
/// a file that it names is saved. Ends with Ctrl-C, or as it is told to.
int watch(const RunOptions& options, int argc, char** argv);

}  // namespace reprise::cli
