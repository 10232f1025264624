#pragma once

#include <functional>

#include "cli/options/options.h"

namespace CLI {
class App;
}

namespace reprise::cli {

/// Adds `test`, `accept` and `golden list`. `add_start` adds what a run may be given: --town,
/// --seed, --set, --for.
void add_golden_commands(CLI::App& app,
                         TestOptions& test,
                         AcceptOptions& accept,
                         GoldenListOptions& list,
                         const std::function<void(CLI::App& command)>& add_start);

}  // namespace reprise::cli
