#include "towns/import/right_of_way.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "world/check.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using Kind = RoadSignal::Kind;

/// The roads into one junction: edges, each with the sign at its end.
struct Approaches {
    std::set<std::string> all, with_stop, with_yield;
};

/// Junctions without lights, by index, that have a sign.
std::map<std::uint32_t, Approaches> signed_junctions(const std::vector<LaneSign>& signs,
                                                     const world::TownT& town) {
    std::map<std::uint32_t, Approaches> found;
    for (const LaneSign& sign : signs) {
        const world::LaneT& lane = town.lanes[sign.lane];
        if (lane.junction == world::none || town.junctions[lane.junction].lit)
            continue;
        Approaches& junction = found[lane.junction];
        (sign.stops ? junction.with_stop : junction.with_yield).insert(lane.edge);
    }
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving && !lane.links.empty())
            if (const auto junction = found.find(lane.junction); junction != found.end())
                junction->second.all.insert(lane.edge);
    return found;
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text)
        safe += c == '&' ? "&amp;" : c == '"' ? "&quot;" : c == '<' ? "&lt;" : std::string(1, c);
    return safe;
}

}  // namespace

std::vector<LaneSign> lane_signs(const OpenDrive& map, const ImportedRoads& roads) {
    constexpr double nearest_to_end =
        25;  // [m] a sign further back belongs to nothing that we know
    std::vector<LaneSign> found;
    for (const SignalSite& site : site_signals(map, roads)) {
        const Kind kind = site.signal->kind;
        if ((kind != Kind::stop && kind != Kind::yield) || !site.lane)
            continue;
        const world::Vec3& end = roads.town.lanes[*site.lane].centre.back();
        if (std::hypot(end.x() - site.foot.x(), end.y() - site.foot.y()) <= nearest_to_end)
            found.push_back({*site.lane, kind == Kind::stop});
    }
    return found;
}

RightOfWay right_of_way(const std::vector<LaneSign>& signs, const world::TownT& town) {
    RightOfWay patch;
    std::set<std::string> lowered;
    for (const auto& [junction, approaches] : signed_junctions(signs, town)) {
        const bool all_stop = approaches.with_stop == approaches.all;
        const bool all_yield = approaches.with_yield == approaches.all;
        const char* type = all_stop                       ? "allway_stop"
                           : all_yield                    ? "right_before_left"
                           : approaches.with_stop.empty() ? "priority"
                                                          : "priority_stop";
        patch.nodes += fmt::format(
            "<node id=\"{}\" type=\"{}\"/>\n", escaped(town.junctions[junction].name), type);
        ++patch.junctions;
        if (all_stop || all_yield)
            continue;
        patch.edges_with_stops.insert(approaches.with_stop.begin(), approaches.with_stop.end());
        lowered.insert(approaches.with_stop.begin(), approaches.with_stop.end());
        lowered.insert(approaches.with_yield.begin(), approaches.with_yield.end());
    }
    for (const std::string& edge : lowered)
        patch.edges += fmt::format("<edge id=\"{}\" priority=\"-1\"/>\n", escaped(edge));
    if (patch.junctions > 0) {
        patch.nodes = "<nodes>\n" + patch.nodes + "</nodes>\n";
        patch.edges = "<edges>\n" + patch.edges + "</edges>\n";
    }
    return patch;
}

std::string stop_only_at(const std::set<std::string>& edges, const std::string& network) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.data(), network.size(), pugi::parse_full);
    REPRISE_CHECK(parsed, "the network that netconvert made is XML");
    for (const pugi::xml_node connection : document.child("net").children("connection"))
        if (*connection.attribute("state").value() == 's' &&
            !edges.contains(connection.attribute("from").value()))
            connection.attribute("state").set_value("m");
    std::ostringstream text;
    document.save(text, "    ");
    return std::move(text).str();
}

ObeyedSigns obeyed_signs(const std::vector<LaneSign>& signs, const world::TownT& town) {
    ObeyedSigns bind;
    for (const auto& [junction, approaches] : signed_junctions(signs, town)) {
        std::set<std::string> edges = approaches.with_stop;
        edges.insert(approaches.with_yield.begin(), approaches.with_yield.end());
        for (const std::string& edge : edges) {
            ++bind.roads;
            bind.giving_way +=
                std::any_of(town.lanes.begin(), town.lanes.end(), [&](const world::LaneT& lane) {
                    return lane.edge == edge &&
                           std::any_of(lane.links.begin(),
                                       lane.links.end(),
                                       [](const world::Link& link) { return link.yields(); });
                });
        }
    }
    return bind;
}

}  // namespace reprise::towns
