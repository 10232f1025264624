#pragma once

#include <filesystem>

namespace reprise::cli {

/// Refuses to write a trace over the one that is read. Throws world::Error.
void refuse_same_file(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace reprise::cli
