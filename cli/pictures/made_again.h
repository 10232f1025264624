// Private to the room: whether what manifests say is made again.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/pictures/file_list.h"

namespace reprise::cli {

/// Whether this program is the one that a manifest names.
bool same_program(const nlohmann::ordered_json& manifest);

/// Says whether files were made again as they were, and as they still are in `root`; else the first
/// that differs. `what` is that what was checked, for people. Returns the exit code.
int tell_made_again(const std::string& what,
                    const std::filesystem::path& root,
                    const FileList& then,
                    const FileList& now,
                    bool same_program);

}  // namespace reprise::cli
