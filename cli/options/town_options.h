#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace reprise::cli {

struct TownImportOptions {
    std::string source;     ///< .xodr, .osm, .net.xml; the last two also with .gz
    std::string directory;  ///< to be made
    std::string name;       ///< of the town; empty: the source's file name without endings
    std::string sidewalks;  ///< guess; empty: as the source has them
    bool left_hand = false;
    bool force = false;
};

struct TownShowOptions {
    std::string town;  ///< as of `reprise run --town`
    std::string output;
    std::vector<double> region;  ///< [m] x, y of the south-west corner, width, height; empty: all
    int size = 1600;             ///< [pixels] of the longer side
};

struct TownCheckOptions {
    std::string town;
    bool json = false;
};

/// What the commands about towns were told.
struct TownOptions {
    std::string command;  ///< import, show or check
    TownImportOptions import;
    TownShowOptions show;
    TownCheckOptions check;
};

/// Adds `town` with import, show and check. `town.command` is set when the line is parsed.
void add_town_commands(CLI::App& app, TownOptions& town);

}  // namespace reprise::cli
