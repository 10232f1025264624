#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

/// Reads a network that an import has written, as a run will do, and lets SUMO load it; `work` is a
/// folder for scratch files. Returns what there is to say of the town, in lines. Throws
/// world::Error "MAP: what came out of it is no town: ...", or "MAP: sumo refuses it: ..." with
/// SUMO's reason; `map` is how the user calls it.
std::string check_import(const std::filesystem::path& network,
                         const std::filesystem::path& work,
                         const std::string& map);

/// Lets SUMO load a network, in a process of its own. Throws world::Error "MAP: sumo refuses it:
/// ..." with SUMO's reason, or with how it crashed.
void require_sumo_takes(const std::string& network,
                        const std::filesystem::path& work,
                        const std::string& map);

}  // namespace reprise::towns
