#pragma once

#include <filesystem>

namespace reprise::cli {

/// `reprise diff A B` of two folders of pictures: for each folder of a sensor whether its files are
/// the same, else how far they are apart. Returns the exit code.
int compare_folders(const std::filesystem::path& expected, const std::filesystem::path& found);

}  // namespace reprise::cli
