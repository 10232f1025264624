#include "towns/maps/opendrive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/maps/direct_junctions.h"
#include "towns/maps/mirrored_opendrive.h"
#include "towns/maps/opendrive_check.h"
#include "towns/maps/reference_line.h"
#include "towns/network/network_xml.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

using Kind = RoadSignal::Kind;

double real(const pugi::xml_node& node, const char* name, double fallback = 0) {
    return number(node.attribute(name).value(), fallback);
}

std::string_view text(const pugi::xml_node& node, const char* name) {
    return node.attribute(name).value();
}

/// [m/s] of a number with OpenDRIVE's unit; none for "no limit" and the like.
std::optional<double> speed_of(const char* written, std::string_view unit) {
    const double value = number(written, -1);
    if (value <= 0 || value > 1000)
        return std::nullopt;
    if (unit == "mph")
        return value * 0.44704;
    if (unit == "km/h")
        return value / 3.6;
    return value;  // m/s is what the standard says where no unit is given
}

// ---- limits -----------------------------------------------------------------------------------

/// The road's limits between two s: [m/s] by the distance from the first s on which each holds. [m]
std::map<double, double> limits_between(const pugi::xml_node& road, double from, double to) {
    constexpr double same = 1e-6;  // [m]
    std::map<double, double> limits;
    for (const pugi::xml_node type : road.children("type")) {
        const double s = real(type, "s");
        if (s > to - same)
            continue;
        if (s <= from + same)
            limits.clear();
        const pugi::xml_node speed = type.child("speed");
        if (const auto limit = speed_of(speed.attribute("max").value(), text(speed, "unit")))
            limits[std::max(s - from, 0.0)] = *limit;
    }
    return limits;
}

void write_limits(pugi::xml_node lane, const std::map<double, double>& limits) {
    // The standard's order: link, width, border, roadMark, material, visibility, speed.
    pugi::xml_node after;
    for (const pugi::xml_node child : lane.children())
        for (const char* name : {"link", "width", "border", "roadMark", "material"})
            if (std::string_view(child.name()) == name)
                after = child;
    for (const auto& [offset, limit] : limits) {
        pugi::xml_node speed =
            after ? lane.insert_child_after("speed", after) : lane.prepend_child("speed");
        speed.append_attribute("sOffset").set_value(fmt::format("{:g}", offset).c_str());
        speed.append_attribute("max").set_value(fmt::format("{:.4f}", limit).c_str());
        speed.append_attribute("unit").set_value("m/s");
        after = speed;
    }
}

/// Writes the road's limits into lanes that have none of their own. Returns how many.
int set_limits(const pugi::xml_node& road) {
    int set = 0;
    for (const pugi::xml_node section : road.child("lanes").children("laneSection")) {
        const pugi::xml_node next = section.next_sibling("laneSection");
        const std::map<double, double> limits =
            limits_between(road, real(section, "s"), next ? real(next, "s") : real(road, "length"));
        for (const char* side : {"left", "right"})
            for (const pugi::xml_node lane : section.child(side).children("lane"))
                if (!limits.empty() && !lane.child("speed") && text(lane, "type") != "sidewalk") {
                    write_limits(lane, limits);
                    ++set;
                }
    }
    return set;
}

/// RoadRunner names roads Road 0, Road 1, ...: these are no streets, and netconvert does not join
/// roads of different names.
void drop_generated_name(pugi::xml_node road) {
    constexpr std::string_view beginning = "Road ";
    const std::string_view name = text(road, "name");
    if (name.starts_with(beginning) &&
        name.find_first_not_of("0123456789", beginning.size()) == std::string_view::npos)
        road.remove_attribute("name");
}

// ---- signals ----------------------------------------------------------------------------------

/// A cubic of the road, such as its elevation, at s.
double cubic_at(const pugi::xml_node& profile, const char* name, double s) {
    pugi::xml_node piece;
    for (const pugi::xml_node next : profile.children(name))
        if (!piece || real(next, "s") <= s + 1e-6)
            piece = next;
    const double ds = s - real(piece, "s");
    return real(piece, "a") +
           ds * (real(piece, "b") + ds * (real(piece, "c") + ds * real(piece, "d")));
}

/// The attributes that tell its kind.
SignalWords words_of(const pugi::xml_node& signal) {
    return {text(signal, "type"),
            text(signal, "subtype"),
            text(signal, "value"),
            text(signal, "unit"),
            text(signal, "name"),
            text(signal, "country"),
            text(signal, "dynamic") == "yes"};
}

/// At the s and t of a signal or object, on the road's surface. Superelevation is left out: the
/// town's road is flat from side to side.
Eigen::Vector3d position_of(const pugi::xml_node& object,
                            const pugi::xml_node& road,
                            const ReferenceLine& line) {
    const double s = real(object, "s"), t = real(object, "t");
    const RoadPose pose = line.at(s);
    return {pose.position.x() - t * std::sin(pose.heading),
            pose.position.y() + t * std::cos(pose.heading),
            cubic_at(road.child("elevationProfile"), "elevation", s)};
}

void read_crossings(const pugi::xml_node& road, OpenDrive& map) {
    for (const pugi::xml_node object : road.child("objects").children("object"))
        if (text(object, "type") == "crosswalk")
            map.crossings.push_back(
                position_of(object, road, ReferenceLine(road.child("planView"))));
}

RoadSignal read_signal(const pugi::xml_node& signal,
                       Kind kind,
                       const pugi::xml_node& road,
                       const ReferenceLine& line) {
    const Eigen::Vector3d foot = position_of(signal, road, line);
    RoadSignal found;
    found.id = text(signal, "id");
    found.kind = kind;
    found.foot = {foot.x(), foot.y(), foot.z()};
    found.heading = line.at(real(signal, "s")).heading + real(signal, "hOffset");
    found.against = text(signal, "orientation") == "-";
    found.bottom = real(signal, "zOffset");
    found.height = real(signal, "height");
    found.limit_kmh = kind == Kind::speed_limit ? limit_kmh(words_of(signal)) : 0;
    return found;
}

/// Is any part of it higher on one side?
bool is_banked(const pugi::xml_node& road) {
    for (const pugi::xml_node piece : road.child("lateralProfile").children("superelevation"))
        for (const char* name : {"a", "b", "c", "d"})
            if (real(piece, name) != 0)
                return true;
    return false;
}

void read_signals(const pugi::xml_node& road, OpenDrive& map) {
    const pugi::xml_node signals = road.child("signals");
    if (!signals.child("signal"))
        return;
    const ReferenceLine line(road.child("planView"));
    for (const pugi::xml_node signal : signals.children("signal")) {
        const SignalWords words = words_of(signal);
        const std::optional<Kind> kind = kind_of(words);
        if (kind && (*kind != Kind::speed_limit || limit_kmh(words) > 0))
            map.signals.push_back(read_signal(signal, *kind, road, line));
        else
            ++map.other_signs;
    }
}

}  // namespace

OpenDrive read_opendrive(const std::string& xml, const std::string& file) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(xml.data(), xml.size());
    if (!parsed)
        throw world::Error(fmt::format("{}:{}: is not an OpenDRIVE map: {}",
                                       file,
                                       line_of(xml, static_cast<std::size_t>(parsed.offset)),
                                       parsed.description()));
    const pugi::xml_node root = document.document_element();
    if (!root.child("road"))
        throw world::Error(
            fmt::format("{}:{}: has no <road>",
                        file,
                        line_of(xml, static_cast<std::size_t>(root.offset_debug()))));
    check_opendrive(root, xml, file);
    OpenDrive map;
    map.left_hand = drives_on_the_left(root, xml, file);
    add_connecting_roads(root, xml, file);
    if (map.left_hand)
        mirror_opendrive(root);
    const pugi::xml_node header = root.child("header");
    map.version = fmt::format("{}.{}", text(header, "revMajor"), text(header, "revMinor"));
    map.origin = {real(header.child("offset"), "x"), real(header.child("offset"), "y")};
    for (const pugi::xml_node road : root.children("road")) {
        map.limits_set += set_limits(road);
        map.banked += is_banked(road) ? 1 : 0;
        drop_generated_name(road);
        read_signals(road, map);
        read_crossings(road, map);
        map.roads.emplace(
            text(road, "id"),
            MapRoad{ReferenceLine(road.child("planView")), std::max(real(road, "length"), 0.0)});
    }
    std::ostringstream prepared;
    document.save(prepared, "", pugi::format_raw);
    map.prepared = std::move(prepared).str();
    return map;
}

}  // namespace reprise::towns
