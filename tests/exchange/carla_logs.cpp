#include "tests/exchange/carla_logs.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace reprise::test {

namespace fs = std::filesystem;

std::string carla_log(const std::string& options) {
    const fs::path path =
        fs::temp_directory_path() / ("reprise_carla_" + std::to_string(getpid()) + ".log");
    const std::string command =
        "python3 '" REPRISE_TESTS "/exchange/make_carla_log.py' '" + path.string() + "' " + options;
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error(command);
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    fs::remove(path);
    return bytes;
}

exchange::CarlaBytes bytes_of(const std::string& log) {
    return {"x.log", log.size(), [log](std::uint64_t offset, std::span<std::uint8_t> out) {
                if (offset + out.size() > log.size())
                    throw std::logic_error("read behind the log's end");
                std::copy_n(
                    log.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
            }};
}

}  // namespace reprise::test
