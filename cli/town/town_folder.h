#pragma once

#include <filesystem>
#include <string>

#include "towns/import/town_import.h"

namespace reprise::cli {

/// Makes a town's folder of a map: in `folder`.partial, which gets its name when all is there and
/// is removed when anything goes wrong. Returns the report. Throws world::Error, also when `folder`
/// is there already; `replace` allows one that an import made, and an empty one is always allowed.
std::string make_town_folder(const towns::TownImport& wish,
                             const std::filesystem::path& folder,
                             bool replace);

}  // namespace reprise::cli
