#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/tool_options.h"
#include "cli/town_options.h"

namespace reprise::cli {

struct RunOptions {
    std::string scenario;
    std::string output;  ///< empty: the scenario's name in the working directory
    std::optional<std::string> town;
    std::optional<std::uint64_t> seed;
    std::optional<double> seconds;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::string level = "full";  ///< how much of each tick is kept
    std::string nudge;           ///< TICK[:ACTOR.FIELD[:UNITS]]; empty: none
};

struct TraceOptions {
    std::string trace;
};

struct InfoOptions {
    std::string trace;
    bool long_form = false;
    bool json = false;
};

struct StripOptions {
    std::string trace;
    std::string output;
    std::string level;
};

struct ExpandOptions {
    std::string trace;
    std::string output;
};

struct RecoverOptions {
    std::string damaged;
    std::string output;
};

struct BranchOptions {
    std::string trace;
    std::string at;  ///< tick, or seconds with an s behind
    std::vector<std::string> scripts;
    std::string output;  ///< a trace, or with several scripts a folder
    std::optional<double> seconds;
    std::vector<std::pair<std::string, std::string>> parameters;
};

struct DiffOptions {
    std::string expected;
    std::string found;
    std::optional<double> tolerance;
    bool json = false;
    bool all = false;  ///< every differing field of the first differing tick
};

struct RenderOptions {
    std::string trace;
    std::string directory;
    std::string weather;               ///< empty: as recorded
    std::vector<std::string> cameras;  ///< rgb, depth, semantic
    int width = 800;
    int height = 600;
    double fov_deg = 90;
    std::string from;  ///< tick, or seconds with an s behind; empty: the first
    std::string to;    ///< likewise; empty: the last
    std::string every = "1s";
    std::uint32_t actor = 0;  ///< 0: the first physics vehicle
    std::vector<double> mount{1.0, 0.0, 1.4};
    double pitch_deg = 0;
    double yaw_deg = 0;
    int threads = 0;  ///< 0: one a core
    bool portable = false;
};

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
