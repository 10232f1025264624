#include "cli/golden/golden_files.h"

#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>
#include <string_view>
#include <vector>

#include "files/output_file.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

void check_writable(const fs::path& path) {
    const files::OutputFile goes_again(path, "the file");
}

void copy_file_whole(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (to.has_parent_path())
        fs::create_directories(to.parent_path(), error);
    std::ifstream in(from, std::ios::binary);
    if (!in)
        throw world::Error(from.string() + ": cannot be read: " + std::strerror(errno));
    files::OutputFile out(to, "the file");
    std::vector<char> bytes(1 << 20);
    while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())), in.gcount() > 0)
        out.append(std::string_view(bytes.data(), static_cast<std::size_t>(in.gcount())));
    out.finish(false);
}

void move_file(const fs::path& from, const fs::path& to) {
    copy_file_whole(from, to);
    std::error_code ignored;
    fs::remove(from, ignored);
}

std::string last_lines(const fs::path& path, std::size_t count) {
    std::ifstream in(path);
    std::deque<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (line.empty())
            continue;
        lines.push_back(line);
        if (lines.size() > count)
            lines.pop_front();
    }
    std::string text;
    for (const std::string& line : lines)
        text += (text.empty() ? "" : "\n") + line;
    return text;
}

void keep_trace(const fs::path& trace, const std::string& chain, const fs::path& folder) {
    if (!kept_trace(chain, folder))
        copy_file_whole(trace, folder / (chain + ".mcap"));
}

std::optional<fs::path> kept_trace(const std::string& chain, const fs::path& folder) {
    const fs::path path = folder / (chain + ".mcap");
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
        return std::nullopt;
    return path;
}

void remove_stale(const fs::path& path, const fs::path& output) {
    std::error_code failed;
    if (!fs::remove(path, failed))
        return;
    // fs::remove takes no folder that has something in it.
    for (fs::path folder = path.parent_path(); fs::remove(folder, failed) && folder != output;)
        folder = folder.parent_path();
}

fs::path place_in(const fs::path& output, const fs::path& path) {
    const fs::path here = fs::current_path();
    fs::path place = output;
    for (const fs::path& part : fs::absolute(path).lexically_normal().lexically_relative(here))
        place /= part == ".." ? "__" : part;
    return place;
}

}  // namespace reprise::cli
