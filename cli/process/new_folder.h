#pragma once

#include <filesystem>
#include <list>

#include "files/ending.h"

namespace reprise::cli {

/// A folder for what a command writes, made with those it lies in. Those that we made go again,
/// when they are empty, unless they are kept: however the command ends.
class NewFolder {
  public:
    /// Throws world::Error when it cannot be made.
    explicit NewFolder(const std::filesystem::path& folder);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    void keep() { made_.clear(); }

  private:
    struct Made {
        explicit Made(const std::filesystem::path& its_path) : path(its_path), note(its_path) {}

        std::filesystem::path path;
        files::RemovedWhenEnded note;
    };

    std::list<Made> made_;  ///< the innermost first
};

}  // namespace reprise::cli
