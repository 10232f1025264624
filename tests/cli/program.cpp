#include "tests/cli/program.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

#include "process/program.h"

namespace reprise::test {

namespace fs = std::filesystem;

Result reprise(const std::vector<std::string>& words, const fs::path& folder) {
    return run_program(REPRISE_PROGRAM, words, folder);
}

Result run_program(const std::string& program,
                   const std::vector<std::string>& words,
                   const fs::path& folder) {
    const process::ProgramResult result =
        process::run_program({.name = program,
                              .words = words,
                              .folder = folder,
                              .most_said = std::numeric_limits<std::size_t>::max()});
    return {result.signal == 0 ? result.code : 128 + result.signal, result.said};
}

Result typed(const std::string& line, const Folder& folder) {
    const std::string bin = fs::path(REPRISE_PROGRAM).parent_path().string();
    return run_program("/bin/sh", {"-c", "PATH='" + bin + "':$PATH; " + line}, folder.path());
}

std::string source(const std::string& path) {
    return std::string(REPRISE_SOURCE) + "/" + path;
}

Folder::Folder() {
    std::string pattern = (fs::temp_directory_path() / "reprise_test_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw std::runtime_error("mkdtemp");
    path_ = pattern;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<std::string> Folder::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(path_))
        if (entry.is_regular_file())
            names.push_back(fs::relative(entry.path(), path_).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string read_file(const fs::path& path) {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
}

void write_file(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace reprise::test
