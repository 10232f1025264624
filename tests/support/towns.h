#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "towns/town_reader.h"
#include "world/town.h"

namespace reprise::test {

/// A network with the town read out of it.
struct Loaded {
    towns::Network network;
    world::TownT town;
};

/// scenarios/towns/NAME/NAME.net.xml, read once in the process.
const Loaded& own_town(const std::string& name);

Loaded load(const std::filesystem::path& network);

/// One of our own towns with another network: `change` sees each line of it and may change it; a
/// line that is empty then is left out.
Loaded load_changed(const std::string& name, const std::function<void(std::string&)>& change);

/// tests/maps/NAME: small maps of our own (make_maps.py there), so that what maps promise is always
/// tested.
std::filesystem::path own_map(const std::string& name);

/// A map that nobody here wrote, from ../shared/maps beside the project or from Debian's
/// sumo-tools. It need not be there: tests over it are extras, which skip with missing_map().
std::filesystem::path real_map(const std::string& name);

/// Why a test over a real map is skipped.
std::string missing_map(const std::filesystem::path& map);

/// Index of a lane; fails the process when there is none.
std::uint32_t lane(const world::TownT& town, std::string_view name);

}  // namespace reprise::test
