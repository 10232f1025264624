#include "towns/import/stubs.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

constexpr double longest_stub = 8;  ///< [m] a bus is longer, and a car needs as much to turn

bool has_word(std::string_view text, std::string_view wanted) {
    const auto words = world::words(text);
    return std::find(words.begin(), words.end(), wanted) != words.end();
}

bool is_for_cars(pugi::xml_node lane) {
    const std::string_view allow = lane.attribute("allow").value();
    return allow.empty() ? !has_word(lane.attribute("disallow").value(), "passenger")
                         : has_word(allow, "passenger");
}

struct Road {
    std::string id, from, to;
    double length = 0;  ///< [m]
};

std::vector<Road> roads_of(pugi::xml_node net) {
    std::vector<Road> roads;
    for (const pugi::xml_node edge : net.children("edge")) {
        const auto lanes = edge.children("lane");
        if (edge.attribute("function").empty() &&
            std::any_of(lanes.begin(), lanes.end(), is_for_cars))
            roads.push_back({edge.attribute("id").value(),
                             edge.attribute("from").value(),
                             edge.attribute("to").value(),
                             number(edge.child("lane").attribute("length").value(), 0)});
    }
    return roads;
}

}  // namespace

std::vector<std::string> stubs(const std::string& network) {
    pugi::xml_document document;
    document.load_buffer(network.data(), network.size());
    const std::vector<Road> roads = roads_of(document.child("net"));
    std::map<std::string, std::set<std::string>> neighbours;
    for (const Road& road : roads) {
        neighbours[road.from].insert(road.to);
        neighbours[road.to].insert(road.from);
    }
    const auto is_end = [&](const std::string& junction, const std::string& other) {
        return neighbours[junction].size() == 1 && neighbours[other].size() > 2;
    };
    std::vector<std::string> ids;
    for (const Road& road : roads)
        if (road.length < longest_stub &&
            (is_end(road.to, road.from) || is_end(road.from, road.to)))
            ids.push_back(road.id);
    return ids;
}

}  // namespace reprise::towns
