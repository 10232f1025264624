#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace reprise::cli {

struct ListOptions {
    std::string noun;
    std::vector<std::string> words;  ///< of `lanes` the town, then what to look for
    bool json = false;
    bool all = false;       ///< lanes: those inside junctions, crossings and walking areas, too
    bool luals = false;     ///< words: as annotations for an editor
    bool markdown = false;  ///< words: as a page
};

struct NewOptions {
    std::string name;
    std::optional<std::string> town;
};

struct LintOptions {
    std::vector<std::string> files;
    std::optional<std::string> town;
    std::optional<double> seconds;  ///< of the dry run
    bool read_only = false;         ///< no dry run
};

/// Each adds the command of its name.
void add_list(CLI::App& app, ListOptions& list);
void add_new(CLI::App& app, NewOptions& fresh);
void add_lint(CLI::App& app, LintOptions& lint);

}  // namespace reprise::cli
