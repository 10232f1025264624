#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/options/run_options.h"

namespace CLI {
class App;
}

namespace reprise::cli {

struct TestOptions : DriverOptions {
    std::vector<std::string> paths;
    std::size_t jobs = 0;  ///< 0: one a core
    std::string junit;     ///< empty: none
    std::string output = "reprise-test";
    std::string keep;  ///< empty: nowhere
    bool list = false;
    bool checks = false;     ///< verdict and events only; a golden need not be there
    std::size_t repeat = 1;  ///< runs of each case, which must be one
};

struct AcceptOptions {
    std::vector<std::string> names;
    std::string because;
    std::string name;               ///< of the case; empty: the scenario as it stands
    std::vector<std::string> pins;  ///< empty: as it was; of a new one: everything
    RunOptions start;               ///< town, seed, seconds and parameters only
    std::size_t jobs = 0;
    std::string keep;
};

struct GoldenListOptions {
    std::vector<std::string> paths;
    bool orphans = false;
};

/// Adds `test`, `accept` and `golden list`. What --set is given goes into `assignments`, as typed.
void add_golden_commands(CLI::App& app,
                         TestOptions& test,
                         AcceptOptions& accept,
                         GoldenListOptions& list,
                         std::vector<std::string>& assignments);

}  // namespace reprise::cli
