// What it must do: take point files of `reprise render` for what their headers say.
// What it assumes: nothing: another program's files are refused.
// How it goes: a header is lines up to one that ends it; what is behind it are the rows.
// What it keeps: nothing.
#include "exchange/point_cloud.h"

#include <fstream>
#include <iterator>
#include <sstream>

#include "world/check.h"

namespace reprise::exchange {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

/// A header's next line, by its words; `text` is what is behind it.
Words next_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::istringstream line{std::string(text.substr(0, end))};
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return {std::istream_iterator<std::string>(line), {}};
}

/// Lines up to and with the one whose first word this is; none where it is not there.
std::vector<Words> header(std::string_view& text, const std::string& last) {
    constexpr std::size_t longest = 64;
    std::vector<Words> lines;
    while (!text.empty() && lines.size() < longest) {
        lines.push_back(next_line(text));
        if (!lines.back().empty() && lines.back().front() == last)
            return lines;
    }
    return {};
}

std::vector<PointCloud::Column> ply_columns(std::string_view& text) {
    std::vector<PointCloud::Column> columns;
    bool binary = false;
    for (const Words& words : header(text, "end_header")) {
        binary = binary || words == Words{"format", "binary_little_endian", "1.0"};
        if (words.size() == 3 && words[0] == "property" &&
            (words[1] == "float" || words[1] == "uint"))
            columns.push_back({words[2], words[1] == "uint"});
        else if (!words.empty() && words[0] == "property")
            return {};
    }
    return binary ? columns : std::vector<PointCloud::Column>();
}

std::vector<PointCloud::Column> pcd_columns(std::string_view& text) {
    std::vector<PointCloud::Column> columns;
    bool binary = false;
    for (const Words& words : header(text, "DATA")) {
        binary = binary || words == Words{"DATA", "binary"};
        for (std::size_t i = 1; i < words.size(); ++i) {
            if (words[0] == "FIELDS")
                columns.push_back({words[i], false});
            if (words[0] == "SIZE" && words[i] != "4")
                return {};
            if (words[0] == "TYPE" && i <= columns.size())
                columns[i - 1].whole = words[i] == "U";
        }
    }
    return binary ? columns : std::vector<PointCloud::Column>();
}

}  // namespace

PointCloud read_point_cloud(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw world::Error(path.string() + ": cannot be read");
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::string_view text = bytes;
    PointCloud cloud;
    if (path.extension() == ".ply")
        cloud.columns = ply_columns(text);
    else if (path.extension() == ".pcd")
        cloud.columns = pcd_columns(text);
    else
        cloud.columns = {{"x"}, {"y"}, {"z"}, {"intensity"}};
    cloud.rows = text;
    if (cloud.columns.size() < 3 || cloud.rows.size() % cloud.row_bytes() != 0)
        throw world::Error(path.string() + ": these are no points that reprise render wrote");
    return cloud;
}

}  // namespace reprise::exchange
