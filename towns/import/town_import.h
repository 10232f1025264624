#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

/// A town to be made of a map.
struct TownImport {
    std::filesystem::path map;     ///< .xodr, .osm[.gz] or .net.xml[.gz]
    std::string name;              ///< of the town; empty: the map's
    bool left_hand = false;        ///< OpenStreetMap only: others say so themselves
    bool guess_sidewalks = false;  ///< add sidewalks and crossings where there are none
};

/// Makes NAME.net.xml, NAME.place.xml and import.txt in `folder`, which exists and is empty. Equal
/// maps give equal bytes. Returns import.txt: what was done, what was changed and what was lost.
/// Throws world::Error, with netconvert's own reason where that refuses the map, when no town comes
/// out of it; the folder then holds anything.
/// Cost: Town07.xodr 0.7 s.
std::string import_town(const TownImport& wish, const std::filesystem::path& folder);

}  // namespace reprise::towns
