#include "files/json_text.h"

#include <fstream>
#include <iterator>
#include <system_error>

namespace reprise::files {

std::string json_text(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        return "";
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return text.find('\0') == std::string::npos ? text : "";
}

}  // namespace reprise::files
