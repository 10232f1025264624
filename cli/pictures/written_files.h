#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace reprise::cli {

struct WrittenFile {
    std::filesystem::path path;
    std::string
        pictures;  ///< of a film: XXH3 of its pictures, as FFmpeg's bytes are its own affair
};

/// The files that a command has written, for its manifest.
class WrittenFiles {
  public:
    /// From any thread.
    void add(const std::filesystem::path& path, const std::string& pictures = "") {
        const std::lock_guard hold(lock_);
        all_.push_back({path, pictures});
    }

    const std::vector<WrittenFile>& all() const { return all_; }

  private:
    std::mutex lock_;
    std::vector<WrittenFile> all_;
};

}  // namespace reprise::cli
