#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace reprise::test {

/// What each fuzz target does with its command line: `--seeds FOLDER` writes inputs to start from.
template <typename WriteSeeds>
int start_fuzzing(const int* argc, char*** argv, WriteSeeds write_seeds) {
    if (*argc == 3 && std::string_view((*argv)[1]) == "--seeds") {
        std::filesystem::create_directories((*argv)[2]);
        write_seeds(std::filesystem::path((*argv)[2]));
        std::exit(0);
    }
    return 0;
}

inline void write_seed(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string read_seed(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace reprise::test
