#include "towns/network/network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>
#include <zlib.h>

#include "towns/network/backward_ways.h"
#include "towns/network/joined_lanes.h"
#include "towns/network/mended_lanes.h"
#include "towns/network/network_check.h"
#include "towns/network/network_xml.h"
#include "towns/network/out_of_place.h"
#include "towns/network/place.h"
#include "towns/network/shared_lanes.h"
#include "towns/network/sharp_corners.h"
#include "towns/network/waiting_places.h"
#include "towns/network/zippers.h"
#include "world/check.h"
#include "world/geometry2d.h"
#include "world/models/vehicle_classes.h"
#include "world/story/wording.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

namespace fs = std::filesystem;

/// [bytes] A network is read whole, as a tree of about four times its size.
constexpr std::uintmax_t largest = std::uintmax_t{512} << 20;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
    throw world::Error(fmt::format("{}: {}", path.string(), what));
}

[[noreturn]] void fail_at(const fs::path& path, std::size_t line, const std::string& what) {
    throw world::Error(fmt::format("{}:{}: {}", path.string(), line, what));
}

/// Names the network that may have been meant.
std::string suggestion(const fs::path& path) {
    std::vector<std::string> siblings;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name.find(".net.xml") != std::string::npos)
            siblings.push_back(name);
    }
    std::sort(siblings.begin(), siblings.end());
    return world::did_you_mean(path.filename().string(), siblings);
}

std::string read_bytes(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
        fail(path,
             status.type() == fs::file_type::not_found ? "no such file" + suggestion(path)
                                                       : "cannot be read: " + error.message());
    if (!fs::is_regular_file(status))
        fail(path,
             fmt::format("is {}; a SUMO network (.net.xml or .net.xml.gz) was expected",
                         fs::is_directory(status) ? "a folder" : "not a file"));
    if (fs::file_size(path, error) > largest && !error)
        fail(path,
             fmt::format(
                 "has {} MB; {} at most can be read", fs::file_size(path) >> 20, largest >> 20));
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    if (fs::file_size(path, error) > 0)
        bytes << file.rdbuf();
    if (!file || error)
        fail(path, "cannot be read");
    return std::move(bytes).str();
}

bool is_gzip(std::string_view bytes) {
    return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

std::string unpack(const fs::path& path, std::string& packed) {
    constexpr int gzip_or_zlib = 15 + 32;
    z_stream stream{};
    REPRISE_CHECK(inflateInit2(&stream, gzip_or_zlib) == Z_OK, "zlib");
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    std::string unpacked;
    std::vector<char> block(1 << 18);
    int status = Z_OK;
    while (status == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        status = inflate(&stream, Z_NO_FLUSH);
        unpacked.append(block.data(), block.size() - stream.avail_out);
        if (unpacked.size() > largest)
            break;
        // SUMO's own programs write a file of several members, one after the other (RFC 1952, 2.2).
        const std::string_view rest(reinterpret_cast<const char*>(stream.next_in), stream.avail_in);
        if (status == Z_STREAM_END && is_gzip(rest))
            status = inflateReset(&stream);
    }
    inflateEnd(&stream);
    if (unpacked.size() > largest)
        fail(path, fmt::format("holds more than {} MB", largest >> 20));
    if (status != Z_STREAM_END)
        fail(path, "is damaged or cut off: gzip cannot unpack it");
    return unpacked;
}

/// What a map in another format can be turned into.
std::string root_hint(std::string_view root, const fs::path& path) {
    if (root != "OpenDRIVE" && root != "osm")
        return "";
    return "; make a town of it: reprise town import " + path.string() + " -o DIR";
}

/// The classes that SUMO 1.15 knows of a list, in their order. Unknown ones are counted.
std::string known_classes(std::string_view list, std::map<std::string, int>& unknown) {
    std::string known;
    for (const std::string_view word : world::words(list)) {
        if (word != "all" && world::class_bit(word) == 0)
            ++unknown[std::string(word)];
        else
            known += (known.empty() ? "" : " ") + std::string(word);
    }
    return known;
}

/// Takes classes that newer versions of SUMO invented out of every list: SUMO 1.15 refuses to load
/// a network that names them. A lane that only such classes may use is then closed to all.
void strip_unknown_classes(pugi::xml_node node, std::map<std::string, int>& unknown) {
    for (const char* name : {"allow", "disallow", "changeLeft", "changeRight", "vClasses"}) {
        pugi::xml_attribute list = node.attribute(name);
        if (list.empty() || world::words(list.value()).empty())
            continue;
        const std::string known = known_classes(list.value(), unknown);
        if (known == list.value())
            continue;
        const bool gives_permission = std::string_view(name) != "disallow";
        if (!known.empty())
            list.set_value(known.c_str());
        else if (std::string_view(name) == "allow")
            node.remove_attribute(list), node.append_attribute("disallow").set_value("all");
        else if (gives_permission)
            list.set_value("custom2");
        else
            node.remove_attribute(list);
    }
    for (const pugi::xml_node child : node.children())
        strip_unknown_classes(child, unknown);
}

/// SUMO 1.15 writes format 1.9 and says nothing when it reads another. Those of 1.x that are newer
/// differ in details that are looked at one by one; of 2.x nothing is known.
void refuse_newer_format(const fs::path& path, std::size_t line, std::string_view version) {
    constexpr double first_unknown = 2;
    if (number(version.substr(0, version.find('.')), 0) >= first_unknown)
        fail_at(path,
                line,
                fmt::format("is too new: SUMO's network format {}, of which 1.x can be read; write "
                            "it again with netconvert 1.x",
                            version));
}

bool has_car_lane(pugi::xml_node net) {
    const world::ClassSet passenger = world::class_bit("passenger");
    for (const pugi::xml_node edge : net.children("edge")) {
        if (*edge.attribute("function").value() != '\0' &&
            std::string_view(edge.attribute("function").value()) != "normal")
            continue;
        for (const pugi::xml_node lane : edge.children("lane"))
            if (world::permitted(lane.attribute("allow").value(),
                                 lane.attribute("disallow").value()) &
                passenger)
                return true;
    }
    return false;
}

/// SUMO 1.15 crashes on a lane that it cannot read when something lies inside of it, so that lanes
/// are read here first. What is wrong with it, or "".
std::string fault_of(pugi::xml_node lane) {
    const double nothing = std::numeric_limits<double>::infinity();
    constexpr double farthest = 1e7;  // [m]
    constexpr double highest = 1e4;   // [m]
    constexpr double widest = 100;    // [m]
    for (const char* name : {"id", "index", "speed", "length", "shape"})
        if (*lane.attribute(name).value() == '\0')
            return fmt::format("<lane> has no {}", name);
    for (const char* name : {"index", "speed", "length"})
        if (number(lane.attribute(name).value(), nothing) == nothing)
            return fmt::format(
                "<lane>: {}=\"{}\" is not a number", name, lane.attribute(name).value());
    for (const std::string_view point : world::words(lane.attribute("shape").value()))
        for (std::size_t from = 0, to = 0, k = 0; to != std::string_view::npos;
             from = to + 1, ++k) {
            to = point.find(',', from);
            const double coordinate = number(point.substr(from, to - from), nothing);
            if (coordinate == nothing)
                return fmt::format("<lane>: '{}' in its shape is not a point", point);
            if (std::abs(coordinate) > farthest)
                return fmt::format("<lane>: '{}' in its shape is farther than 10,000 km away",
                                   point);
            if (k == 2 && std::abs(coordinate) > highest)
                return fmt::format("<lane>: '{}' in its shape is more than 10 km high or deep",
                                   point);
        }
    if (world::words(lane.attribute("shape").value()).size() < 2)
        return "<lane>: its shape needs two points at least";
    for (const char* name : {"speed", "length", "width"}) {
        const char* text = lane.attribute(name).value();
        const double value = *text == '\0' ? 1 : number(text, nothing);
        // Lanes of no width are closed when they are read (mended_lanes.h).
        const bool is_closed = value == 0 && std::string_view(name) == "width";
        if (value == nothing || (value <= 0 && !is_closed))
            return fmt::format("<lane>: {}=\"{}\" is not a number above 0", name, text);
        if (value > widest && std::string_view(name) == "width")
            return fmt::format("<lane>: width=\"{}\" is more than {} m", text, widest);
    }
    return "";
}

void check_lanes(const fs::path& path, std::string_view xml, pugi::xml_node net) {
    const auto fail_lane = [&](pugi::xml_node lane, const std::string& fault) {
        fail_at(path, line_of(xml, static_cast<std::size_t>(lane.offset_debug())), fault);
    };
    std::vector<Eigen::Vector2d> corners;  // two of each lane
    std::vector<pugi::xml_node> lanes;
    for (const pugi::xml_node edge : net.children("edge"))
        for (const pugi::xml_node lane : edge.children("lane")) {
            if (const std::string fault = fault_of(lane); !fault.empty())
                fail_lane(lane, fault);
            world::Box box;
            for (const world::Vec3& point : parse_shape(lane.attribute("shape").value()))
                box.take({point.x(), point.y()});
            corners.insert(corners.end(), {box.low, box.high});
            lanes.push_back(lane);
        }
    if (const auto corner = out_of_place(corners)) {
        const pugi::xml_node lane = lanes[*corner / 2];
        fail_lane(lane,
                  fmt::format("<lane id=\"{}\">: lies so far away that the town would be wider "
                              "than {:.0f} km",
                              lane.attribute("id").value(),
                              widest_town / 1000));
    }
}

std::string name_of(const fs::path& path) {
    std::string name = path.filename().string();
    for (const std::string_view ending : {".gz", ".xml", ".net"})
        if (name.size() > ending.size() && name.ends_with(ending))
            name.erase(name.size() - ending.size());
    return name;
}

/// What NAME.place.xml beside the network holds; "" when there is none.
std::string place_beside(const fs::path& network, const std::string& name) {
    const fs::path path = network.parent_path() / (name + ".place.xml");
    std::error_code ignored;
    if (path == network || !fs::exists(path, ignored))
        return "";
    std::string xml = read_bytes(path);
    read_place(xml, path.string());  // so that mistakes are told with their path
    return xml;
}

/// Writes the tree back as text, without indents: only networks that had to be changed pass here.
std::string to_text(const pugi::xml_document& document) {
    std::ostringstream text;
    document.save(text, "", pugi::format_raw);
    return std::move(text).str();
}

/// A line for each kind of change.
std::string notes_on(const MendedLanes& mended, const fs::path& path) {
    std::string notes;
    const auto note = [&](std::size_t count, const char* what, std::string_view changed) {
        if (count > 0)
            notes +=
                fmt::format("{}: {} {}\n", path.string(), world::count_of(count, what), changed);
    };
    note(mended.folds, "lane", "with a point at which the line turned back: it is left out");
    note(mended.lengths,
         "road",
         "counted longer or shorter than drawn: the length is that of the drawing now");
    note(mended.closed, "lane", "of width 0: closed");
    return notes;
}

}  // namespace

Network load_network(const std::filesystem::path& path) {
    Network network;
    network.name = name_of(path);
    network.xml = read_bytes(path);
    if (is_gzip(network.xml))
        network.xml = unpack(path, network.xml);
    if (network.xml.find_first_not_of(" \t\r\n") == std::string::npos)
        fail_at(path, 1, "is empty; a SUMO network was expected");

    // Is it XML, and the right kind?
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.xml.data(), network.xml.size());
    if (!parsed)
        fail_at(path,
                line_of(network.xml, static_cast<std::size_t>(parsed.offset)),
                fmt::format("is not a SUMO network: {}", parsed.description()));
    const pugi::xml_node root = document.document_element();
    const std::size_t root_line =
        line_of(network.xml, static_cast<std::size_t>(root.offset_debug()));
    if (std::string_view(root.name()) != "net")
        fail_at(
            path,
            root_line,
            fmt::format("expected <net>, found <{}>{}", root.name(), root_hint(root.name(), path)));

    refuse_newer_format(path, root_line, root.attribute("version").value());
    if (!has_car_lane(root))
        fail_at(path, root_line, "has no edge that a passenger car may use");
    check_lanes(path, network.xml, root);
    check_network(path, network.xml, root);

    // Words of newer SUMO versions.
    std::map<std::string, int> unknown;
    strip_unknown_classes(root, unknown);
    for (const auto& [word, count] : unknown)
        network.notes +=
            fmt::format("{}: SUMO 1.15 has no vehicle class '{}': taken out of {} lists\n",
                        path.string(),
                        word,
                        count);
    const std::size_t parted = part_shared_lanes(root);
    if (parted > 0)
        network.notes += fmt::format(
            "{}: {} of several lanes that oncoming traffic may use as well (bidi): SUMO 1.15 "
            "cannot "
            "simulate that, so cars do not see the oncoming ones there\n",
            path.string(),
            world::count_of(parted, "road"));
    network.notes += notes_on(mend_lanes(root), path);
    if (!has_car_lane(root))
        fail_at(path, root_line, "has no edge that a passenger car may use, but lanes of no width");
    if (const std::size_t backward = mend_backward_ways(root); backward > 0)
        network.notes += fmt::format(
            "{}: {} through junctions drawn against the traffic, as the roads overlap: these are "
            "cut\n",
            path.string(),
            world::count_of(backward, "way"));
    if (const std::size_t corners = mend_sharp_corners(root); corners > 0)
        network.notes += fmt::format(
            "{}: {} through junctions turned back onto a road: it begins or ends further away "
            "now\n",
            path.string(),
            world::count_of(corners, "way"));
    if (const std::size_t zippers = mend_zippers(root); zippers > 0)
        network.notes += fmt::format(
            "{}: {} where more than two lanes take turns (zipper), which SUMO 1.15 cannot "
            "simulate: "
            "who goes straight on goes first there\n",
            path.string(),
            world::count_of(zippers, "junction"));
    if (const std::size_t joined = part_joined_lanes(root); joined > 0)
        network.notes += fmt::format(
            "{}: {} of ways onto different lanes of one road that gave way to each other for "
            "nothing: they do not now\n",
            path.string(),
            world::count_of(joined, "pair"));
    const std::size_t moved = move_waiting_places(root);
    if (moved > 0 || !network.notes.empty())
        network.xml = to_text(document);
    network.place = place_beside(path, network.name);
    return network;
}

}  // namespace reprise::towns
