#include "cli/town/towns.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "cli/process/say.h"
#include "cli/town/town_folder.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

/// Folders that hold towns: beside the scenario, and where this build or installation keeps its
/// own.
std::vector<fs::path> town_folders(const fs::path& scenario) {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    return {
        scenario.parent_path() / "towns",
        program / "../../../scenarios/towns",            // build/<preset>/bin
        program / "../share/reprise/scenarios/towns",    // PREFIX/bin
        program / "../../share/reprise/scenarios/towns"  // PREFIX/libexec/reprise
    };
}

/// Those in a folder; none where there is no such folder.
std::vector<fs::path> networks_in(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.ends_with(".net.xml") || name.ends_with(".net.xml.gz"))
            found.push_back(entry.path());
    }
    return found;
}

/// The town of that name in the first of the folders that has it, or an empty path. Its network has
/// the town's name, or is the only one there: a map's, that was imported under another name.
fs::path network_named(const std::string& town, const std::vector<fs::path>& folders) {
    if (town.empty() || town.front() == '.')
        return {};
    std::error_code ignored;
    for (const fs::path& folder : folders) {
        fs::path network = folder / town / (town + ".net.xml");
        if (fs::exists(network, ignored))
            return network;
        const std::vector<fs::path> others = networks_in(folder / town);
        if (const auto others = networks_in(folder / town); others.size() == 1)
            return others.front();
    }
    return {};
}

std::vector<std::string> names_in(const std::vector<fs::path>& folders) {
    std::vector<std::string> names;
    for (const fs::path& folder : folders) {
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder, ignored)) {
            const std::string name = entry.path().filename().string();
            if (entry.is_directory() && !network_named(name, {folder}).empty())
                names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

/// The one network in a folder.
fs::path network_in(const fs::path& folder) {
    const std::vector<fs::path> found = networks_in(folder);
    if (found.size() != 1)
        throw world::Error(folder.string() + ": is a folder with " +
                           (found.empty() ? "no" : std::to_string(found.size())) +
                           " SUMO networks (.net.xml); one was expected");
    return found.front();
}

/// What must be imported first.
bool is_map(const std::string& town) {
    std::error_code ignored;
    if (fs::is_directory(town, ignored))
        return false;
    return town.ends_with(".xodr") || town.ends_with(".osm") || town.ends_with(".osm.gz");
}

/// A town made of a map for this run only.
towns::Network import_map(const std::string& map) {
    std::string folder = (fs::temp_directory_path() / "reprise_town_XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
        throw world::Error(folder + ": cannot be made: " + std::strerror(errno));

    struct Remove {
        const std::string& folder;

        ~Remove() {
            std::error_code ignored;
            fs::remove_all(folder, ignored);
        }
    } const remove{folder};

    say(stderr, "{}: importing it; `reprise town import` would keep the town\n", map);
    make_town_folder({map, "", false, false}, folder, false);
    return towns::load_network(network_in(folder));
}

bool looks_like_path(const std::string& town) {
    return town.find('/') != std::string::npos || town.ends_with(".xml") || town.ends_with(".gz") ||
           is_map(town);
}

std::string joined_names(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}

fs::path find_network(const std::string& town, const fs::path& scenario) {
    std::error_code ignored;
    const bool has_ending = town.ends_with(".xodr") || town.ends_with(".osm");
    if ((has_ending || town.find('/') != std::string::npos) && fs::is_directory(town, ignored))
        return network_in(town);
    if (looks_like_path(town) || fs::is_regular_file(town, ignored))
        return town;
    const auto folders = town_folders(scenario);
    if (fs::path network = network_named(town, folders); !network.empty())
        return network;
    if (fs::is_directory(town, ignored))
        return network_in(town);
    const auto names = names_in(folders);
    throw world::Error(
        "no town '" + world::printable(town) + "'" + world::did_you_mean(town, names) +
        "; there are " + joined_names(names) +
        ", or give the path of a SUMO network (.net.xml), a town's folder or a map (.xodr, .osm)");
}

}  // namespace

towns::Network load_town(const std::string& town, const fs::path& scenario) {
    return is_map(town) ? import_map(town) : towns::load_network(find_network(town, scenario));
}

std::vector<NamedTown> named_towns() {
    const auto folders = town_folders({});
    std::vector<NamedTown> towns;
    for (const std::string& name : names_in(folders))
        towns.push_back({name, network_named(name, folders).lexically_normal()});
    return towns;
}

std::vector<fs::path> scenario_folders() {
    std::vector<fs::path> folders{".", "scenarios"};
    const auto with_towns = town_folders({});
    for (auto folder = with_towns.begin() + 1; folder != with_towns.end(); ++folder)
        folders.push_back(folder->parent_path());
    return folders;
}

towns::Network load_named_town(const std::string& name, const fs::path& folder) {
    const auto folders = town_folders(folder / "any.lua");
    const bool is_name =
        !name.empty() && name.front() != '.' &&
        std::all_of(name.begin(), name.end(), [](unsigned char letter) {
            return std::isalnum(letter) != 0 || letter == '_' || letter == '-' || letter == '.';
        });
    if (is_name)
        if (fs::path network = network_named(name, folders); !network.empty())
            return towns::load_network(network);
    const auto names = names_in(folders);
    throw world::Error("no town '" + world::printable(name) + "'" +
                       world::did_you_mean(name, names) + "; there are " + joined_names(names));
}

}  // namespace reprise::cli
