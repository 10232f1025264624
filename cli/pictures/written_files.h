#pragma once

#include <filesystem>
#include <mutex>
#include <vector>

namespace reprise::cli {

/// The files that a command has written, for its manifest.
class WrittenFiles {
  public:
    /// From any thread.
    void add(const std::filesystem::path& path) {
        const std::lock_guard hold(lock_);
        paths_.push_back(path);
    }

    const std::vector<std::filesystem::path>& paths() const { return paths_; }

  private:
    std::mutex lock_;
    std::vector<std::filesystem::path> paths_;
};

}  // namespace reprise::cli
