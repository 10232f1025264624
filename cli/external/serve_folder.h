#pragma once

#include <filesystem>
#include <string>

namespace reprise::cli {

/// A file that a client of `reprise serve` names: it stands in the folder itself, and is no link.
/// `ending`, such as ".lua". Throws world::Error for anything that could lead out of it.
std::filesystem::path file_in(const std::filesystem::path& folder,
                              const std::string& name,
                              const std::string& ending);

}  // namespace reprise::cli
