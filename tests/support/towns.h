#pragma once

#include <cstdint>
#include <filesystem>
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

/// Index of a lane; fails the process when there is none.
std::uint32_t lane(const world::TownT& town, std::string_view name);

}  // namespace reprise::test
