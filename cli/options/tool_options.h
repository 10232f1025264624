#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace reprise::cli {

struct CatOptions {
    std::string trace;
    std::string topic;  ///< tick, traffic; empty: both
    std::string ticks;  ///< A..B; empty: all
    std::string actor;  ///< name or id; empty: all
    std::vector<std::string> fields;
    std::string format = "jsonl";
};

struct GetOptions {
    std::string trace;
    std::string part;
    std::string output;  ///< empty: the standard output
};

struct StatsOptions {
    std::string trace;
    std::string ticks;  ///< A..B; empty: all
    std::string actor;  ///< name or id; empty: all
    bool json = false;
};

struct ScoreOptions {
    std::string trace;
    std::string actor;  ///< name or id; empty: all
    bool json = false;
};

struct SliceOptions {
    std::string trace;
    std::string ticks;
    std::string output;
};

struct MergeOptions {
    std::vector<std::string> traces;
    std::string output;
};

struct QueryOptions {
    std::string trace;
    std::string sql;  ///< empty: say which tables there are
    std::string format = "csv";
};

struct ExportOptions {
    std::string trace;
    std::string format;
    std::string output;
    std::string ticks;
    std::string actor;   ///< csv and jsonl: name or id; empty: all
    std::string every;   ///< empty: every tick; foxglove: 0.1s
    std::string images;  ///< foxglove only
};

struct ShowOptions {
    std::string trace;
    std::string output;  ///< empty: beside the trace
    std::string ticks;
    std::string every;  ///< empty: all, or of long runs so many that the page stays small
};

struct ImportOptions {
    std::string log;
    std::string output;
    std::string town;  ///< empty: a plain
    double step_ms = 50;
};

/// What the commands that read and convert traces were told.
struct ToolOptions {
    CatOptions cat;
    GetOptions get;
    StatsOptions stats;
    ScoreOptions score;
    SliceOptions slice;
    MergeOptions merge;
    QueryOptions query;
    ExportOptions export_to;
    ShowOptions show;
    ImportOptions import_from;
};

/// Adds cat, get, stats, score, slice, merge, query, export, show and import.
void add_tool_commands(CLI::App& app, ToolOptions& tools);

}  // namespace reprise::cli
