#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "towns/town_reader.h"

namespace reprise::cli {

/// The network of a town, and what lies beside it. `town` is the path of a network, of a folder
/// that holds one, or of a map (.xodr, .osm[.gz]), which is imported then (and said so on stderr);
/// or a name, looked up as towns/NAME/NAME.net.xml beside the scenario, then in the scenarios that
/// belong to this program. Throws world::Error that lists the towns there are.
towns::Network load_town(const std::string& town, const std::filesystem::path& scenario = {});

/// A town that a scenario can name.
struct NamedTown {
    std::string name;
    std::filesystem::path network;
};

/// Those in towns/ of this folder and in this program's own, by name.
std::vector<NamedTown> named_towns();

/// Where scenarios are: this folder, its folder scenarios/, and this program's own.
std::vector<std::filesystem::path> scenario_folders();

/// Of a town that others name: its name only, looked up in `folder`/towns, then in this program's
/// own. Throws world::Error for what is no name, such as a path.
towns::Network load_named_town(const std::string& name, const std::filesystem::path& folder);

}  // namespace reprise::cli
