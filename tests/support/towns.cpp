#include "tests/support/towns.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <unistd.h>

namespace reprise::test {

Loaded load(const std::filesystem::path& network) {
    Loaded loaded;
    loaded.network = towns::load_network(network);
    loaded.town = towns::read_town(loaded.network);
    return loaded;
}

const Loaded& own_town(const std::string& name) {
    static std::map<std::string, Loaded> towns;
    const auto known = towns.find(name);
    if (known != towns.end())
        return known->second;
    const std::filesystem::path folder =
        std::filesystem::path(REPRISE_SOURCE_DIR) / "scenarios/towns";
    return towns.emplace(name, load(folder / name / (name + ".net.xml"))).first->second;
}

Loaded load_changed(const std::string& name, const std::function<void(std::string&)>& change) {
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::temp_directory_path() / ("reprise_changed_" + name + '_' + std::to_string(getpid()));
    fs::create_directory(folder);
    const std::string file = name + ".net.xml";
    {
        std::ifstream from(fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns" / name / file);
        std::ofstream to(folder / file);
        for (std::string line; std::getline(from, line);) {
            change(line);
            if (!line.empty())
                to << line << '\n';
        }
    }
    Loaded loaded = load(folder / file);
    fs::remove_all(folder);
    return loaded;
}

std::filesystem::path own_map(const std::string& name) {
    return std::filesystem::path(REPRISE_SOURCE_DIR) / "tests/maps" / name;
}

std::filesystem::path real_map(const std::string& name) {
    const auto beside = std::filesystem::path(REPRISE_SOURCE_DIR) / "../shared/maps" / name;
    const auto debian = std::filesystem::path("/usr/share/sumo/tools/game") / name;
    return std::filesystem::exists(debian) ? debian : beside;
}

std::string missing_map(const std::filesystem::path& map) {
    return "SKIPPED: the real map " + map.string() + " is not there; own maps were tested";
}

std::uint32_t lane(const world::TownT& town, std::string_view name) {
    const auto found = world::find_lane(town, name);
    if (!found) {
        std::cerr << "no lane " << name << " in " << town.name << '\n';
        std::abort();
    }
    return *found;
}

}  // namespace reprise::test
