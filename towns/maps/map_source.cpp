#include "towns/maps/map_source.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "world/check.h"

namespace reprise::towns {

namespace {

namespace fs = std::filesystem;

// OpenDRIVE and networks are read whole, as trees; OpenStreetMap is read as a stream.
constexpr std::uint64_t largest_tree = std::uint64_t{256} << 20;
constexpr std::uint64_t largest_stream = std::uint64_t{2} << 30;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
    throw world::Error(fmt::format("{}: {}", path.string(), what));
}

constexpr std::string_view expected =
    "an OpenDRIVE (.xodr), OpenStreetMap (.osm) or SUMO (.net.xml) map was expected";

/// Reads plain files and those compressed with gzip alike.
class Reader {
  public:
    explicit Reader(const fs::path& path) : path_(path), file_(gzopen(path.c_str(), "rb")) {
        if (!file_)
            fail(path, "cannot be read");
    }

    /// The next bytes; empty at the end.
    std::string_view next() {
        const int count = gzread(file_.get(), block_.data(), static_cast<unsigned>(block_.size()));
        int error = Z_OK;
        gzerror(file_.get(), &error);
        if (count < 0 || (error != Z_OK && error != Z_STREAM_END))
            fail(path_, "is damaged or cut off: gzip cannot unpack it");
        return {block_.data(), static_cast<std::size_t>(count)};
    }

    bool packed() const { return gzdirect(file_.get()) == 0; }

  private:
    struct Close {
        void operator()(gzFile file) const { gzclose(file); }
    };

    fs::path path_;
    std::unique_ptr<gzFile_s, Close> file_;
    std::vector<char> block_ = std::vector<char>(1 << 18);
};

/// Behind white space, comments, the declaration and the like: where the first element begins.
std::string_view first_element(std::string_view text) {
    if (text.substr(0, 3) == "\xef\xbb\xbf")
        text.remove_prefix(3);
    for (;;) {
        const std::size_t start = text.find_first_not_of(" \t\r\n");
        if (start == std::string_view::npos || text[start] != '<')
            return "";
        text.remove_prefix(start + 1);
        if (text.empty() || (text.front() != '?' && text.front() != '!'))
            return text.substr(0, text.find_first_of(" \t\r\n/>"));
        const std::size_t brackets = text.substr(0, text.find('>')).find('[');
        const std::string_view ending = text.starts_with("!--")              ? "-->"
                                        : brackets != std::string_view::npos ? "]>"
                                                                             : ">";
        const std::size_t end = text.find(ending);
        if (end == std::string_view::npos)
            return "";
        text.remove_prefix(end + ending.size());
    }
}

MapKind kind_of(const fs::path& path, std::string_view beginning) {
    if (beginning.find_first_not_of(" \t\r\n") == std::string_view::npos)
        fail(path, fmt::format("is empty; {}", expected));
    const std::string_view element = first_element(beginning);
    const bool is_name = !element.empty() && element.size() < 60 &&
                         std::all_of(element.begin(), element.end(), [](unsigned char c) {
                             return c > 0x20 && c < 0x7f;
                         });
    if (beginning.starts_with("\xff\xfe") || beginning.starts_with("\xfe\xff"))
        fail(path, "is written in UTF-16; UTF-8 was expected");
    if (!is_name)
        fail(path, fmt::format("is not XML; {}", expected));
    if (element == "OpenDRIVE")
        return MapKind::opendrive;
    if (element == "osm")
        return MapKind::openstreetmap;
    if (element == "net")
        return MapKind::network;
    fail(path, fmt::format("begins with <{}>; {}", element, expected));
}

std::string name_of(const fs::path& path) {
    std::string name = path.filename().string();
    for (const std::string_view ending : {".gz", ".xml", ".net", ".osm", ".xodr"})
        if (name.size() > ending.size() && name.ends_with(ending))
            name.erase(name.size() - ending.size());
    return harmless_name(name);
}

void unpack(const fs::path& path, const fs::path& target, std::uint64_t largest) {
    Reader reader(path);
    std::ofstream file(target, std::ios::binary);
    std::uint64_t size = 0;
    for (std::string_view bytes = reader.next(); !bytes.empty(); bytes = reader.next()) {
        size += bytes.size();
        if (size > largest)
            fail(path, fmt::format("holds more than {} MB", largest >> 20));
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    file.close();
    if (!file)
        fail(target, "cannot be written");
}

void require_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
        fail(path,
             status.type() == fs::file_type::not_found ? "no such file"
                                                       : "cannot be read: " + error.message());
    if (!fs::is_regular_file(status))
        fail(path,
             fmt::format(
                 "is {}; {}", fs::is_directory(status) ? "a folder" : "not a file", expected));
}

}  // namespace

std::string harmless_name(const std::string& text) {
    std::string name = text;
    for (char& c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!letter && !(c >= '0' && c <= '9') && c != '_' && c != '-' && c != '.')
            c = '_';
    }
    // Not hidden, and not "..".
    if (name.empty() || name.front() == '.' || name.front() == '-')
        name.insert(0, "_");
    return name;
}

MapSource open_map(const fs::path& path, const fs::path& scratch) {
    require_file(path);
    MapSource source{MapKind::network, path, name_of(path)};
    bool packed = false;
    {
        Reader reader(path);
        source.kind = kind_of(path, reader.next());
        packed = reader.packed();
    }
    const std::uint64_t largest =
        source.kind == MapKind::openstreetmap ? largest_stream : largest_tree;
    if (packed) {
        source.file = scratch / "unpacked.xml";
        unpack(path, source.file, largest);
    } else if (fs::file_size(path) > largest) {
        fail(
            path,
            fmt::format(
                "has {} MB; {} at most can be imported", fs::file_size(path) >> 20, largest >> 20));
    }
    return source;
}

}  // namespace reprise::towns
