#pragma once

#include <filesystem>
#include <string>

namespace reprise::cli {

/// A file that a client of `reprise serve` names: it stands in the folder itself, and is no link.
/// `ending`, such as ".lua". Throws world::Error for anything that could lead out of it.
std::filesystem::path file_in(const std::filesystem::path& folder,
                              const std::string& name,
                              const std::string& ending);

/// Towns of that folder stand in it as well: neither `towns` in it, nor the town of this name, nor
/// anything in that is a link. Throws world::Error.
void refuse_links_to_towns(const std::filesystem::path& folder, const std::string& town = "");

/// What went wrong, for a client: files of the folder by their names in it, as the client knows
/// them; where the folder stands on the server is not its business.
std::string as_named_in(const std::filesystem::path& folder, std::string message);

}  // namespace reprise::cli
