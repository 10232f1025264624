#include "towns/maps/mirrored_opendrive.h"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

/// What changes its sign. ASAM OpenDRIVE 1.4 to 1.8; what is not read by anyone here is left out.
struct Signed {
    const char* element;
    const char* parent;  ///< nullptr: any
    std::array<const char*, 4> attributes;
};

constexpr std::array signed_values{
    Signed{"geometry", nullptr, {"y", "hdg"}},
    Signed{"arc", nullptr, {"curvature"}},
    Signed{"spiral", nullptr, {"curvStart", "curvEnd"}},
    Signed{"poly3", nullptr, {"a", "b", "c", "d"}},
    Signed{"paramPoly3", nullptr, {"aV", "bV", "cV", "dV"}},
    Signed{"laneOffset", nullptr, {"a", "b", "c", "d"}},
    Signed{"superelevation", nullptr, {"a", "b", "c", "d"}},
    Signed{"lane", nullptr, {"id"}},
    Signed{"predecessor", "link", {"id"}},  // of a lane; roads' own have no such parent's parent
    Signed{"successor", "link", {"id"}},
    Signed{"laneLink", nullptr, {"from", "to"}},
    Signed{"validity", nullptr, {"fromLane", "toLane"}},
    Signed{"signal", nullptr, {"t", "hOffset"}},
    Signed{"signalReference", nullptr, {"t"}},
    Signed{"object", nullptr, {"t", "hdg"}},
    Signed{"objectReference", nullptr, {"t"}},
    Signed{"repeat", nullptr, {"tStart", "tEnd"}},
    Signed{"cornerRoad", nullptr, {"t"}},
    Signed{"cornerLocal", nullptr, {"v"}},
    Signed{"offset", "header", {"y", "hdg"}},
};

/// Another sign before the same digits.
void negate(pugi::xml_attribute value) {
    const std::string_view text = value.value();
    if (text.empty() || number(text, 0) == 0)
        return;
    value.set_value(
        (text.front() == '-' ? std::string(text.substr(1)) : "-" + std::string(text)).c_str());
}

class Negater : public pugi::xml_tree_walker {
  public:
    bool for_each(pugi::xml_node& node) override {
        const std::string_view name = node.name();
        const pugi::xml_node parent = node.parent();
        // The <link> of a road names roads.
        if (std::string_view(parent.name()) == "link" &&
            std::string_view(parent.parent().name()) != "lane")
            return true;
        for (const Signed& entry : signed_values)
            if (name == entry.element &&
                (entry.parent == nullptr || std::string_view(parent.name()) == entry.parent))
                for (const char* attribute : entry.attributes)
                    if (attribute != nullptr && *attribute != '\0')
                        negate(node.attribute(attribute));
        return true;
    }
};

/// The lanes of both sides change places; each side lists its lanes from left to right.
void swap_sides(pugi::xml_node section) {
    pugi::xml_node left = section.child("left");
    pugi::xml_node right = section.child("right");
    pugi::xml_node centre = section.child("center");
    for (pugi::xml_node side : {left, right}) {
        std::vector<pugi::xml_node> lanes;
        for (const pugi::xml_node lane : side.children("lane"))
            lanes.push_back(lane);
        for (const pugi::xml_node lane : lanes)
            side.prepend_move(lane);
    }
    if (left)
        left.set_name("right");
    if (right)
        right.set_name("left");
    if (centre && left)
        section.insert_move_after(left, centre);
    if (centre && right)
        section.insert_move_before(right, centre);
}

}  // namespace

bool drives_on_the_left(const pugi::xml_node& root, std::string_view xml, const std::string& file) {
    const auto is_left = [](const pugi::xml_node& road) {
        return std::string_view(road.attribute("rule").value()) == "LHT";
    };
    const pugi::xml_node first = root.child("road");
    for (const pugi::xml_node road : root.children("road"))
        if (is_left(road) != is_left(first))
            throw world::Error(fmt::format(
                "{}:{}: <road id=\"{}\">: traffic drives on the {} here, and on the {} on road "
                "'{}'; one rule was expected for all of the map: write rule=\"{}\" into each "
                "<road>",
                file,
                line_of(xml, static_cast<std::size_t>(road.offset_debug())),
                road.attribute("id").value(),
                is_left(road) ? "left" : "right",
                is_left(first) ? "left" : "right",
                first.attribute("id").value(),
                is_left(first) ? "LHT" : "RHT"));
    return is_left(first);
}

void mirror_opendrive(pugi::xml_node root) {
    Negater negater;
    root.traverse(negater);
    for (pugi::xml_node road : root.children("road")) {
        if (pugi::xml_attribute rule = road.attribute("rule"))
            rule.set_value("RHT");
        for (const pugi::xml_node section : road.child("lanes").children("laneSection"))
            swap_sides(section);
    }
}

}  // namespace reprise::towns
