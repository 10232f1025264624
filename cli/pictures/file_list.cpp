#include "cli/pictures/file_list.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "world/check.h"
#include "world/digest.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string read_all(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();  // in blocks: byte by byte it took longer than a sweep of LiDAR
    if (!file.is_open() || file.bad() || fs::is_directory(path))
        throw world::Error(path.string() + ": cannot be read");
    return std::move(text).str();
}

}  // namespace

std::string file_digest(const fs::path& path) {
    return world::to_hex(world::digest128(read_all(path)));
}

Json file_list(std::vector<WrittenFile> files, const fs::path& root) {
    std::sort(files.begin(), files.end(), [](const WrittenFile& one, const WrittenFile& other) {
        return one.path < other.path;
    });
    Json list = Json::array();
    for (const WrittenFile& file : files) {
        Json& one = list.emplace_back();
        one["path"] = file.path.lexically_relative(root).string();
        one["bytes"] = fs::file_size(file.path);
        one["xxh3"] = file_digest(file.path);
        if (!file.pictures.empty())
            one["pictures_xxh3"] = file.pictures;
    }
    return list;
}

FileList read_file_list(const Json& files, const std::string& where) {
    const auto is_text = [](const Json& in, const char* key) {
        return in.is_object() && in.contains(key) && in[key].is_string();
    };
    FileList list;
    for (const Json& file : files) {
        if (!is_text(file, "path") || !is_text(file, "xxh3") ||
            (file.contains("pictures_xxh3") && !is_text(file, "pictures_xxh3")))
            throw world::Error(where + ": what it says of its files was changed");
        const auto whole = file["xxh3"].get<std::string>();
        list[file["path"].get<std::string>()] = {whole, file.value("pictures_xxh3", whole)};
    }
    return list;
}

}  // namespace reprise::cli
