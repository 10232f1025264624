// Private to the room: what manifests say of files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/pictures/written_files.h"

namespace reprise::cli {

/// XXH3-128 of a file. Throws world::Error when it cannot be read.
std::string file_digest(const std::filesystem::path& path);

/// Of a file: its own bytes', and what is to come out again: the same, of a film its pictures'.
struct FileDigests {
    std::string file;
    std::string made;
};

/// By its path in the folder that a manifest is about.
using FileList = std::map<std::string, FileDigests>;

/// What a manifest says of these files, with size and XXH3; by their paths from `root`. Throws
/// world::Error when one cannot be read.
nlohmann::ordered_json file_list(std::vector<WrittenFile> files, const std::filesystem::path& root);

/// What that said. Throws world::Error with `where` when it is no such list.
FileList read_file_list(const nlohmann::ordered_json& files, const std::string& where);

}  // namespace reprise::cli
