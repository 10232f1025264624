#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/options/dataset_options.h"
#include "cli/options/discover_options.h"
#include "cli/options/drive_options.h"
#include "cli/options/golden_options.h"
#include "cli/options/render_options.h"
#include "cli/options/run_options.h"
#include "cli/options/serve_options.h"
#include "cli/options/tool_options.h"
#include "cli/options/town_options.h"
#include "cli/options/trace_options.h"

namespace reprise::cli {

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
    VerifyOptions verify;
    InfoOptions info;
    DiffOptions diff;
    RecoverOptions recover;
    StripOptions strip;
    ExpandOptions expand;
    BranchOptions branch;
    RenderOptions render;
    DatasetOptions dataset;
    TestOptions test;
    AcceptOptions accept;
    GoldenListOptions golden_list;
    ToolOptions tools;
    TownOptions town;
    ServeOptions serve;
    DriveOptions drive;
    ListOptions list;
    NewOptions fresh;
    LintOptions lint;

  private:
    struct App;
    std::unique_ptr<App> app_;
};

}  // namespace reprise::cli
