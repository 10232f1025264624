#include "traffic/right_of_way.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

#include "world/town.h"

namespace reprise::traffic {

namespace {

using Kind = RoadSignal::Kind;

/// The roads into one junction: edges, each with the sign at its end.
struct Approaches {
    std::set<std::string> all, with_stop, with_yield;
};

/// Junctions without lights, by index, that have a sign.
std::map<std::uint32_t, Approaches> signed_junctions(const OpenDrive& map,
                                                     const ImportedRoads& roads) {
    constexpr double nearest_to_end =
        25;  // [m] a sign further back belongs to nothing that we know
    const world::TownT& town = roads.town;
    std::map<std::uint32_t, Approaches> found;
    for (const SignalSite& site : site_signals(map, roads)) {
        const Kind kind = site.signal->kind;
        if ((kind != Kind::stop && kind != Kind::yield) || !site.lane)
            continue;
        const world::LaneT& lane = town.lanes[*site.lane];
        const world::Vec3& end = lane.centre.back();
        const double to_end = std::hypot(end.x() - site.foot.x(), end.y() - site.foot.y());
        if (lane.junction == world::none || town.junctions[lane.junction].lit ||
            to_end > nearest_to_end)
            continue;
        Approaches& junction = found[lane.junction];
        (kind == Kind::stop ? junction.with_stop : junction.with_yield).insert(lane.edge);
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

RightOfWay right_of_way(const OpenDrive& map, const ImportedRoads& roads) {
    RightOfWay patch;
    std::set<std::string> lowered;
    for (const auto& [junction, approaches] : signed_junctions(map, roads)) {
        const bool all_stop = approaches.with_stop == approaches.all;
        const bool all_yield = approaches.with_yield == approaches.all;
        const char* type = all_stop                       ? "allway_stop"
                           : all_yield                    ? "right_before_left"
                           : approaches.with_stop.empty() ? "priority"
                                                          : "priority_stop";
        patch.nodes += fmt::format(
            "<node id=\"{}\" type=\"{}\"/>\n", escaped(roads.town.junctions[junction].name), type);
        ++patch.junctions;
        if (all_stop || all_yield)
            continue;
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

SignsThatBind signs_that_bind(const OpenDrive& map, const ImportedRoads& roads) {
    SignsThatBind bind;
    for (const auto& [junction, approaches] : signed_junctions(map, roads)) {
        std::set<std::string> edges = approaches.with_stop;
        edges.insert(approaches.with_yield.begin(), approaches.with_yield.end());
        for (const std::string& edge : edges) {
            ++bind.roads;
            bind.giving_way += std::any_of(
                roads.town.lanes.begin(), roads.town.lanes.end(), [&](const world::LaneT& lane) {
                    return lane.edge == edge &&
                           std::any_of(lane.links.begin(),
                                       lane.links.end(),
                                       [](const world::Link& link) { return link.yields(); });
                });
        }
    }
    return bind;
}

}  // namespace reprise::traffic
