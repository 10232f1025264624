#include "cli/golden/golden_files.h"

#include <cerrno>
#include <cstdlib>
#include <deque>
#include <fstream>

#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
    throw world::Error(path.string() + ": cannot be written: " + error.message());
}

fs::path partial_of(const fs::path& path) {
    return path.string() + ".partial";
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "reprise_XXXXXX").string();
    if (!error && mkdtemp(pattern.data()) == nullptr)
        error.assign(errno, std::generic_category());
    if (error)
        throw world::Error("cannot make a temporary folder (TMPDIR): " + error.message());
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void write_whole(const fs::path& path, const std::string& text) {
    const fs::path partial = partial_of(path);
    std::ofstream out(partial, std::ios::binary);
    out << text;
    out.close();
    std::error_code error(errno, std::generic_category());
    if (out)
        fs::rename(partial, path, error);
    if (!error && out)
        return;
    std::error_code ignored;
    fs::remove(partial, ignored);
    fail(path, error);
}

void check_writable(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error))
        fail(path, std::make_error_code(std::errc::is_a_directory));
    const fs::path partial = partial_of(path);
    if (!std::ofstream(partial, std::ios::binary))
        fail(path, std::error_code(errno, std::generic_category()));
    fs::remove(partial, error);
}

void copy_file_whole(const fs::path& from, const fs::path& to) {
    const fs::path partial = partial_of(to);
    try {
        if (to.has_parent_path())
            fs::create_directories(to.parent_path());
        fs::copy_file(from, partial, fs::copy_options::overwrite_existing);
        fs::rename(partial, to);
    } catch (const fs::filesystem_error& error) {
        std::error_code ignored;
        fs::remove(partial, ignored);
        fail(to, error.code());
    }
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
