#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace reprise::test {

struct Result {
    int code = -1;
    std::string out;  ///< stdout and stderr, in the order written
};

/// Runs `reprise` with these words in `folder` and waits.
Result reprise(const std::vector<std::string>& words, const std::filesystem::path& folder = ".");

/// Likewise, another program.
Result run_program(const std::string& program,
                   const std::vector<std::string>& words,
                   const std::filesystem::path& folder = ".");

/// A file of the source tree.
std::string source(const std::string& path);

/// A folder of its own for each test, empty, removed afterwards.
class Folder {
  public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

    const std::filesystem::path& path() const { return path_; }

    std::vector<std::string> files() const;

  private:
    std::filesystem::path path_;
};

/// Types a line into a shell in that folder, as a user would: `reprise` is found.
Result typed(const std::string& line, const Folder& folder);

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace reprise::test
