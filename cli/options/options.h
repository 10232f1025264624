#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/options/run_options.h"
#include "cli/options/tool_options.h"
#include "cli/options/town_options.h"
#include "cli/options/trace_options.h"

namespace reprise::cli {

struct TestOptions {
    std::vector<std::string> paths;
    std::size_t jobs = 0;  ///< 0: one a core
    std::string junit;     ///< empty: none
    std::string output = "reprise-test";
    std::string keep;  ///< empty: nowhere
    bool list = false;
};

struct AcceptOptions {
    std::vector<std::string> names;
    std::string because;
    std::string name;  ///< of the case; empty: the scenario as it stands
    RunOptions start;  ///< town, seed, seconds and parameters only
    std::size_t jobs = 0;
    std::string keep;
};

struct GoldenListOptions {
    std::vector<std::string> paths;
    bool orphans = false;
};

/// The whole command line of all programs in one place: the thin `reprise` parses it, answers help,
/// versions and mistakes at once, and hands the same words on to the program that does the work.
class CommandLine {
  public:
    CommandLine();
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Returns an exit code when that is all there was to do (help, version, a mistake, which has
    /// been printed), or nothing when `command` should now be carried out.
    std::optional<int> parse(int argc, char** argv);

    std::string command;  ///< run, verify, info, diff, ..., or one of ToolOptions
    RunOptions run;
    TraceOptions verify;
    InfoOptions info;
    DiffOptions diff;
    RecoverOptions recover;
    StripOptions strip;
    ExpandOptions expand;
    BranchOptions branch;
    RenderOptions render;
    TestOptions test;
    AcceptOptions accept;
    GoldenListOptions golden_list;
    ToolOptions tools;
    TownOptions town;

  private:
    struct App;
    std::unique_ptr<App> app_;
};

}  // namespace reprise::cli
