#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

enum class MapKind { opendrive, openstreetmap, network };

/// A map that can become a town.
struct MapSource {
    MapKind kind = MapKind::network;
    std::filesystem::path file;  ///< plain XML: the map itself, or the decompressed copy of it
    std::string name;            ///< of the town: the file name without endings, harmless as a name
};

/// Tells the kind of a file by its first element, without reading all of it. Files compressed with
/// gzip are decompressed into `scratch`, 2 GB at most. Throws world::Error, in bounded time and
/// memory, when it is none of the three, missing, damaged or too large.
MapSource open_map(const std::filesystem::path& path, const std::filesystem::path& scratch);

/// Letters, digits, '_', '-' and '.' of a text; whatever else is a '_'. At least one character.
std::string harmless_name(const std::string& text);

}  // namespace reprise::towns
