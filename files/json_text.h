#pragma once

#include <filesystem>
#include <string>

namespace reprise::files {

/// The text of a file for a JSON parser. Empty, which is no JSON, when it is no plain file, cannot
/// be read, or holds a NUL: parsers take that as the end, and would let anything follow.
std::string json_text(const std::filesystem::path& path);

}  // namespace reprise::files
