#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "world/town_generated.h"

namespace reprise::traffic {

/// The bytes of a SUMO network (.net.xml or .net.xml.gz, unpacked), after checks: it exists, is
/// XML, is a network, and libsumo 1.15 can load it. Vehicle classes that newer versions invented
/// are taken out of allow/disallow lists and reported in `notes`. Throws world::Error:
/// "town.net.xml:17: ..." with what was expected and a suggestion.
struct Network {
    std::string name;  ///< file name without endings
    std::string xml;
    std::string notes;  ///< what was changed, one line each; empty: nothing
    /// NAME.place.xml beside it (towns/network/place.h); empty: none.
    std::string place = {};
};

Network load_network(const std::filesystem::path& path);

/// Reads the Town out of a network: lanes with neighbours and links, junctions, signals, sidewalks,
/// crossings; what stands beside the roads is the place's, the rest drawn by a fixed rule
/// (scenery.h). Pure: equal bytes in, equal Town out. Throws world::Error when there is no lane
/// that a car may use. Town 1: 60 ms.
world::TownT read_town(const Network& network);

}  // namespace reprise::traffic
