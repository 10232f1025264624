#pragma once

#include <functional>

#include "cli/options/options.h"

namespace reprise::cli {

/// All of a program's main(): reads the command line, and carries out what it says within
/// guarded().
int command_main(int argc, char** argv, const std::function<int(const CommandLine&)>& carry_out);

}  // namespace reprise::cli
