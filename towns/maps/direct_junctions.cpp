#include "towns/maps/direct_junctions.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/maps/reference_line.h"
#include "towns/network/network_xml.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

constexpr double connecting_length = 0.1;  // [m]

double number_of(const pugi::xml_node& node, const char* name) {
    return number(node.attribute(name).value(), 0);
}

/// The cubic polynomial that holds at s, out of those that begin at their `start`. [m]
double cubic_at(const pugi::xml_node& parent, const char* element, const char* start, double s) {
    double value = 0;
    for (const pugi::xml_node piece : parent.children(element)) {
        const double ds = s - number_of(piece, start);
        if (ds < 0)
            break;
        value = number_of(piece, "a") +
                ds * (number_of(piece, "b") +
                      ds * (number_of(piece, "c") + ds * number_of(piece, "d")));
    }
    return value;
}

void put(pugi::xml_node node, const char* name, double value) {
    node.append_attribute(name).set_value(fmt::format("{:.9f}", value).c_str());
}

void put(pugi::xml_node node, const char* name, const std::string& value) {
    node.append_attribute(name).set_value(value.c_str());
}

/// A polynomial that is the same everywhere.
void put_constant(pugi::xml_node node, const char* start, double value) {
    put(node, start, 0);
    put(node, "a", value);
    for (const char* name : {"b", "c", "d"})
        put(node, name, 0);
}

/// A road where it touches a junction: at its start or at its end.
struct Contact {
    pugi::xml_node road;
    bool at_start;

    double s() const { return at_start ? 0 : number_of(road, "length"); }

    /// The number of a lane as seen from the junction, where the road leads away. Its own inverse.
    int away(int lane) const { return at_start ? lane : -lane; }

    const char* name() const { return at_start ? "start" : "end"; }

    pugi::xml_node section() const {
        pugi::xml_node found;
        for (const pugi::xml_node section : road.child("lanes").children("laneSection"))
            if (!found || !at_start)
                found = section;
        return found;
    }
};

class Connector {
  public:
    Connector(const pugi::xml_node& root, std::string_view xml, const std::string& file)
        : root_(root),
          xml_(xml),
          file_(file) {
        for (const pugi::xml_node road : root.children("road"))
            roads_.emplace(road.attribute("id").value(), road);
    }

    /// One junction; how many roads that took.
    int connect(pugi::xml_node junction) {
        int added = 0;
        for (const pugi::xml_node connection : junction.children("connection"))
            if (connection.attribute("linkedRoad")) {
                connect(junction, connection);
                ++added;
            }
        junction.remove_attribute("type");
        return added;
    }

  private:
    void connect(const pugi::xml_node& junction, pugi::xml_node connection) {
        const std::string at = junction.attribute("id").value();
        const pugi::xml_node incoming = road_of(connection, "incomingRoad");
        const pugi::xml_node successor = incoming.child("link").child("successor");
        const Contact from{
            incoming,
            std::string_view(successor.attribute("elementType").value()) != "junction" ||
                at != successor.attribute("elementId").value()};
        const Contact to{road_of(connection, "linkedRoad"),
                         std::string_view(connection.attribute("contactPoint").value()) != "end"};
        const std::string id = free_id(fmt::format(
            "{}_{}_{}", at, incoming.attribute("id").value(), to.road.attribute("id").value()));
        std::map<int, int> links;  // lane of the linked road: lane of the incoming one
        for (pugi::xml_node link : connection.children("laneLink")) {
            const int target = link.attribute("to").as_int();
            links.emplace(target, link.attribute("from").as_int());
            link.attribute("to").set_value(to.away(target));
        }
        draw(id, at, from, to, links);
        connection.remove_attribute("linkedRoad");
        connection.remove_attribute("contactPoint");
        put(connection, "connectingRoad", id);
        put(connection, "contactPoint", "start");
    }

    /// A road that leads from one contact to the other, with the lanes that the other one has
    /// there.
    void draw(const std::string& id,
              const std::string& junction,
              const Contact& from,
              const Contact& to,
              const std::map<int, int>& links) {
        pugi::xml_node road = root_.insert_child_before("road", root_.child("junction"));
        put(road, "id", id);
        put(road, "junction", junction);
        put(road, "length", connecting_length);
        if (const pugi::xml_attribute rule = to.road.attribute("rule"))
            put(road, "rule", rule.value());
        pugi::xml_node link = road.append_child("link");
        for (const auto& [name, contact] : {std::pair{"predecessor", &from}, {"successor", &to}}) {
            pugi::xml_node other = link.append_child(name);
            put(other, "elementType", std::string("road"));
            put(other, "elementId", std::string(contact->road.attribute("id").value()));
            put(other, "contactPoint", std::string(contact->name()));
        }
        if (const pugi::xml_node type = to.road.child("type"))
            road.append_copy(type).attribute("s").set_value("0");
        draw_line(road, to);
        put_constant(road.append_child("elevationProfile").append_child("elevation"),
                     "s",
                     cubic_at(to.road.child("elevationProfile"), "elevation", "s", to.s()));
        draw_lanes(road.append_child("lanes"), to, links);
    }

    static void draw_line(pugi::xml_node road, const Contact& to) {
        const RoadPose pose = ReferenceLine(to.road.child("planView")).at(to.s());
        const double heading = pose.heading + (to.at_start ? 0 : std::numbers::pi);
        pugi::xml_node line = road.append_child("planView").append_child("geometry");
        put(line, "s", 0);
        put(line, "x", pose.position.x() - connecting_length * std::cos(heading));
        put(line, "y", pose.position.y() - connecting_length * std::sin(heading));
        put(line, "hdg", heading);
        put(line, "length", connecting_length);
        line.append_child("line");
    }

    /// Lanes that this connection does not join are no lanes here, but keep their width.
    static void draw_lanes(pugi::xml_node lanes,
                           const Contact& to,
                           const std::map<int, int>& links) {
        const double offset = cubic_at(to.road.child("lanes"), "laneOffset", "s", to.s());
        if (offset != 0)
            put_constant(lanes.append_child("laneOffset"), "s", to.at_start ? offset : -offset);
        const pugi::xml_node of = to.section();
        const double s = to.s() - number_of(of, "s");
        std::map<int, pugi::xml_node, std::greater<>> by_place;  // from left to right
        for (const char* side : {"left", "right"})
            for (const pugi::xml_node lane : of.child(side).children("lane"))
                by_place.emplace(to.away(lane.attribute("id").as_int()), lane);
        pugi::xml_node section = lanes.append_child("laneSection");
        put(section, "s", 0);
        pugi::xml_node left = section.append_child("left");
        pugi::xml_node centre = section.append_child("center").append_child("lane");
        put(centre, "id", std::string("0"));
        put(centre, "type", std::string("none"));
        pugi::xml_node right = section.append_child("right");
        for (const auto& [place, of_linked] : by_place) {
            const auto joined = links.find(to.away(place));
            pugi::xml_node lane = (place > 0 ? left : right).append_child("lane");
            put(lane, "id", std::to_string(place));
            put(lane, "type", joined == links.end() ? "none" : of_linked.attribute("type").value());
            if (joined != links.end()) {
                pugi::xml_node link = lane.append_child("link");
                put(link.append_child("predecessor"), "id", std::to_string(joined->second));
                put(link.append_child("successor"), "id", std::to_string(to.away(place)));
            }
            put_constant(
                lane.append_child("width"), "sOffset", cubic_at(of_linked, "width", "sOffset", s));
        }
        for (pugi::xml_node side : {left, right})
            if (!side.first_child())
                section.remove_child(side);
    }

    pugi::xml_node road_of(const pugi::xml_node& connection, const char* attribute) const {
        const auto found = roads_.find(connection.attribute(attribute).value());
        if (found == roads_.end())
            throw world::Error(
                fmt::format("{}:{}: <connection>: {}=\"{}\": no such road",
                            file_,
                            line_of(xml_, static_cast<std::size_t>(connection.offset_debug())),
                            attribute,
                            connection.attribute(attribute).value()));
        return found->second;
    }

    std::string free_id(const std::string& wish) {
        std::string id = wish;
        for (int i = 2; roads_.count(id) > 0 || !added_.insert(id).second; ++i)
            id = fmt::format("{}_{}", wish, i);
        return id;
    }

    pugi::xml_node root_;
    std::string_view xml_;
    const std::string& file_;
    std::map<std::string, pugi::xml_node, std::less<>> roads_;
    std::set<std::string> added_;
};

}  // namespace

int add_connecting_roads(pugi::xml_node root, std::string_view xml, const std::string& file) {
    Connector connector(root, xml, file);
    int added = 0;
    for (pugi::xml_node junction : root.children("junction"))
        if (std::string_view(junction.attribute("type").value()) == "direct")
            added += connector.connect(junction);
    return added;
}

}  // namespace reprise::towns
