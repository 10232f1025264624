#pragma once

#include <filesystem>
#include <vector>

#include "cli/pictures/written_files.h"

namespace reprise::cli {

/// What lies already where pictures go to.
class EarlierRendering {
  public:
    /// Takes a folder's manifest away: from now on, until another one is written, it is not whole.
    /// A film is replaced with its manifest, and stays until then. Throws world::Error where a file
    /// of that name is somebody else's.
    explicit EarlierRendering(const std::filesystem::path& output);

    /// Files of it that were not made anew: the new manifest is not about them.
    std::vector<std::filesystem::path> left_beside(const WrittenFiles& files) const;

  private:
    std::vector<std::filesystem::path> files_;
};

}  // namespace reprise::cli
