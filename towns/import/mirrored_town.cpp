#include "towns/import/mirrored_town.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/lanes/road_place.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using std::string_view;

/// Another sign before the same digits.
std::string negated(string_view text) {
    if (text.empty() || number(text, 0) == 0)
        return std::string(text);
    return text.front() == '-' ? std::string(text.substr(1)) : "-" + std::string(text);
}

/// "x,y x,y,z": every second coordinate of a point.
std::string mirrored_points(string_view points) {
    std::string mirrored;
    for (const string_view point : world::words(points)) {
        const std::size_t first = std::min(point.find(','), point.size());
        const std::size_t second = std::min(point.find(',', first + 1), point.size());
        mirrored.append(mirrored.empty() ? "" : " ").append(point.substr(0, first));
        if (first < point.size())
            mirrored.append(",").append(negated(point.substr(first + 1, second - first - 1)));
        mirrored.append(point.substr(second));
    }
    return mirrored;
}

/// "low x,low y,high x,high y"
std::string mirrored_box(string_view box) {
    std::vector<string_view> sides;
    for (std::size_t from = 0; from <= box.size();) {
        const std::size_t to = std::min(box.find(',', from), box.size());
        sides.push_back(box.substr(from, to - from));
        from = to + 1;
    }
    if (sides.size() != 4)
        return std::string(box);
    return std::string(sides[0]) + "," + negated(sides[3]) + "," + std::string(sides[2]) + "," +
           negated(sides[1]);
}

/// SUMO's letters for the way that a connection turns.
const char* mirrored_turn(string_view dir) {
    constexpr std::array<std::array<const char*, 2>, 6> turns{
        {{"l", "r"}, {"r", "l"}, {"L", "R"}, {"R", "L"}, {"t", "T"}, {"T", "t"}}};
    for (const auto& [turn, other] : turns)
        if (dir == turn)
            return other;
    return nullptr;
}

class Mirror : public pugi::xml_tree_walker {
  public:
    bool for_each(pugi::xml_node& node) override {
        const string_view name = node.name();
        for (const char* line : {"shape", "outlineShape", "netOffset"})
            if (pugi::xml_attribute points = node.attribute(line))
                points.set_value(mirrored_points(points.value()).c_str());
        if (pugi::xml_attribute y = node.attribute("y"))
            y.set_value(negated(y.value()).c_str());
        for (const char* box : {"convBoundary"})
            if (pugi::xml_attribute sides = node.attribute(box))
                sides.set_value(mirrored_box(sides.value()).c_str());
        // On earth, only the map itself is where it says.
        pugi::xml_attribute original = node.attribute("origBoundary");
        if (original && string_view(node.attribute("projParameter").value()) == "!")
            original.set_value(mirrored_box(original.value()).c_str());
        if (pugi::xml_attribute dir = node.attribute("dir"); dir && name == "connection")
            if (const char* other = mirrored_turn(dir.value()))
                dir.set_value(other);
        if (name == "param" && string_view(node.attribute("key").value()) == "road")
            mirror_road(node.attribute("value"));
        return true;
    }

  private:
    static void mirror_road(pugi::xml_attribute value) {
        std::vector<world::RoadPiece> pieces = world::read_road_pieces(value.value());
        for (world::RoadPiece& piece : pieces)
            piece.lane = -piece.lane;
        value.set_value(world::road_pieces_text(pieces).c_str());
    }
};

}  // namespace

std::string mirrored_network(const std::string& network) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.data(), network.size(), pugi::parse_full);
    REPRISE_CHECK(parsed, "the network that netconvert made is XML");
    Mirror mirror;
    document.traverse(mirror);
    pugi::xml_node net = document.child("net");
    net.remove_attribute("lefthand");
    net.append_attribute("lefthand").set_value("true");
    std::ostringstream text;
    document.save(text, "    ");
    return std::move(text).str();
}

void mirror_place(Place& place) {
    for (Place::Head& head : place.heads) {
        head.foot = {head.foot.x(), -head.foot.y(), head.foot.z()};
        head.yaw = -head.yaw;
        head.arm = -head.arm;
    }
    for (world::Prop& sign : place.signs)
        sign = {{sign.position().x(), -sign.position().y(), sign.position().z()},
                -sign.yaw(),
                sign.length(),
                sign.width(),
                sign.height(),
                sign.style(),
                sign.value(),
                sign.kind(),
                sign.reserved()};
}

}  // namespace reprise::towns
