#include "towns/network/shared_lanes.h"

#include <iterator>
#include <map>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace reprise::towns {

std::size_t part_shared_lanes(pugi::xml_node net) {
    struct Edge {
        std::string_view other;  ///< that it shares its lanes with
        std::ptrdiff_t lanes = 0;
    };

    std::map<std::string_view, Edge> edges;
    for (const pugi::xml_node edge : net.children("edge")) {
        const auto lanes = edge.children("lane");
        edges[edge.attribute("id").value()] = {edge.attribute("bidi").value(),
                                               std::distance(lanes.begin(), lanes.end())};
    }
    const auto is_simple = [&](std::string_view id, std::string_view partner) {
        const auto found = edges.find(id);
        return found != edges.end() && found->second.lanes == 1 && found->second.other == partner;
    };
    std::vector<pugi::xml_node> faulty;
    std::size_t roads = 0;
    for (const pugi::xml_node edge : net.children("edge")) {
        const std::string_view id = edge.attribute("id").value();
        const std::string_view other = edge.attribute("bidi").value();
        if (!edge.attribute("bidi") || (is_simple(id, other) && is_simple(other, id)))
            continue;
        faulty.push_back(edge);
        const auto partner = edges.find(other);
        const bool counted = partner != edges.end() && partner->second.other == id && other < id;
        roads += !counted && !id.starts_with(':') ? 1U : 0U;
    }
    for (pugi::xml_node edge : faulty)
        edge.remove_attribute("bidi");
    return roads;
}

}  // namespace reprise::towns
