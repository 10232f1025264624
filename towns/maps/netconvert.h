#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace reprise::towns {

/// Runs netconvert, polyconvert or sumo in the folder `scratch`, so that words need no paths (they
/// split those at commas), with schema checks off, within bounds of memory and processor time.
/// Returns how many warnings it gave. Throws world::Error "MAP: netconvert refuses it: ..." with
/// the program's own reason; `map` is how the user calls it.
int run_sumo_tool(const std::string& program,
                  std::vector<std::string> words,
                  const std::filesystem::path& scratch,
                  const std::string& map);

/// Where Debian's SUMO keeps its type maps. Not SUMO_HOME: equal maps make equal towns everywhere.
std::filesystem::path sumo_folder();

/// The reason in what a SUMO program said: its errors, joined in one line; else its last line.
std::string reason_in(const std::string& said);

/// What suits an OpenDRIVE map in `file`.
std::vector<std::string> opendrive_words(const std::string& file);

/// What suits an OpenStreetMap map in `file`.
std::vector<std::string> openstreetmap_words(const std::string& file, bool left_hand);

}  // namespace reprise::towns
