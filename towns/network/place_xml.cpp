// What it must do: write a Place so that read_place finds it again, equal places as equal bytes.
// How it goes: an XML tree of pugixml's, whose numbers are written here: in millimetres, without
// the
//   noughts at their ends, and without attributes that are 0.
#include <algorithm>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/place.h"
#include "towns/network/sign_words.h"
#include "world/check.h"
#include "world/models/building_models.h"
#include "world/units.h"

namespace reprise::towns {

namespace {

using world::Vec3;
using Outline = std::vector<Vec3>;

constexpr int millimetres = 3;     ///< decimals
constexpr int of_long_sights = 6;  ///< decimals of degrees: a millimetre at 10 km is 6e-6

/// "-0" is 0.
std::string text_of(double value, int decimals = millimetres) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string shape_of(const Outline& outline) {
    std::string text;
    for (const Vec3& point : outline) {
        text +=
            fmt::format("{}{},{}", text.empty() ? "" : " ", text_of(point.x()), text_of(point.y()));
        if (const std::string z = text_of(point.z()); z != "0")
            text += "," + z;
    }
    return text;
}

void set(pugi::xml_node node, const char* name, const std::string& text) {
    node.append_attribute(name) = text.c_str();
}

/// A value that is 0 where it is left out.
void set_unless_0(pugi::xml_node node, const char* name, double value) {
    if (const std::string text = text_of(value); text != "0")
        set(node, name, text);
}

void set_pose(pugi::xml_node node, const Vec3& at, double yaw) {
    set(node, "x", text_of(at.x()));
    set(node, "y", text_of(at.y()));
    set(node, "z", text_of(at.z()));
    set(node, "yaw", text_of(yaw / world::degree, of_long_sights));
}

void add_head(pugi::xml_node root, const Place::Head& head) {
    pugi::xml_node node = root.append_child("head");
    set(node, "program", head.program);
    set(node, "links", fmt::format("{}", fmt::join(head.links, " ")));
    set_pose(node, head.foot, head.yaw);
    set(node, "height", text_of(head.height));
    set(node, "arm", text_of(head.arm));
}

void add_sign(pugi::xml_node root, const world::Prop& sign) {
    const auto word = std::find_if(sign_words.begin(), sign_words.end(), [&](const auto& known) {
        return known.second == sign.kind();
    });
    REPRISE_CHECK(word != sign_words.end(), world::EnumNamePropKind(sign.kind()));
    pugi::xml_node node = root.append_child("sign");
    set(node, "kind", word->first);
    set_unless_0(node, "value", sign.value());
    set_pose(node, sign.position(), sign.yaw());
    set(node, "height", text_of(sign.height()));
    set_unless_0(node, "length", sign.length());
    set_unless_0(node, "width", sign.width());
    set_unless_0(node, "style", sign.style());
}

void add_building(pugi::xml_node root, const world::DrawnBuildingT& building) {
    pugi::xml_node node = root.append_child("building");
    set(node, "shape", shape_of(building.outline));
    set(node, "height", text_of(building.height));
    if (building.model != 0)
        set(node, "model", std::string(world::building_models()[building.model - 1].name));
    set_unless_0(node, "style", building.style);
}

}  // namespace

std::string place_xml(const Place& place) {
    pugi::xml_document document;
    pugi::xml_node root = document.append_child("place");
    for (const Place::Head& head : place.heads)
        add_head(root, head);
    for (const world::Prop& sign : place.signs)
        add_sign(root, sign);
    for (const world::PlotT& plot : place.plots) {
        pugi::xml_node node = root.append_child("plot");
        set(node, "kind", world::EnumNamePlotKind(plot.kind));
        set(node, "shape", shape_of(plot.outline));
    }
    for (const world::DrawnBuildingT& building : place.buildings)
        add_building(root, building);
    for (const Place::District& district : place.districts) {
        pugi::xml_node node = root.append_child("district");
        set(node, "style", district.style);
        if (!district.outline.empty())
            set(node, "shape", shape_of(district.outline));
    }
    for (const Outline& outline : place.keep_clear)
        set(root.append_child("keep_clear"), "shape", shape_of(outline));
    std::ostringstream text;
    document.save(text, "  ", pugi::format_indent | pugi::format_no_declaration);
    return std::move(text).str();
}

}  // namespace reprise::towns
