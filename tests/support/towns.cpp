#include "tests/support/towns.h"

#include <cstdlib>
#include <iostream>
#include <map>

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
    const std::filesystem::path folder = std::string(REPRISE_SOURCE_DIR) + "/scenarios/towns";
    return towns.emplace(name, load(folder / name / (name + ".net.xml"))).first->second;
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
