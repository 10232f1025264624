#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

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

}  // namespace reprise::towns
