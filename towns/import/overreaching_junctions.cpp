// Must: name the junctions between which no road has room.
// Assumes: a network that netconvert made with these joins: "cluster_1_2_3_4_#7more" is one.
// Goes: a way through a junction that runs against both roads that it joins says that the
//   shorter of them has no room; the junctions at its ends become one.
// Keeps: nothing. netconvert draws anew, and may reach over one more: the caller asks again.
#include "towns/import/overreaching_junctions.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/frames.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using Line = std::vector<world::Vec3>;

constexpr double against = -0.5;  ///< cosine of a turn at both ends of a way

/// In plan; zero: there is none.
Eigen::Vector2d direction(const world::Vec3& from, const world::Vec3& to) {
    const Eigen::Vector2d way = world::in_plan(to) - world::in_plan(from);
    return way.norm() > 0 ? way.normalized() : Eigen::Vector2d(0, 0);
}

bool is_for_walkers_only(pugi::xml_node lane) {
    return std::string_view(lane.attribute("allow").value()) == "pedestrian";
}

struct Lane {
    pugi::xml_node edge;
    double length = 0;  ///< [m]
    Line line;
};

std::map<std::string, Lane> lanes_of(pugi::xml_node net) {
    std::map<std::string, Lane> lanes;
    for (const pugi::xml_node edge : net.children("edge"))
        for (const pugi::xml_node lane : edge.children("lane"))
            if (!is_for_walkers_only(lane))
                lanes[lane.attribute("id").value()] = {
                    edge,
                    number(lane.attribute("length").value(), 0),
                    parse_shape(lane.attribute("shape").value())};
    return lanes;
}

/// Junctions of the network that are to become one, in pairs.
std::vector<std::pair<std::string, std::string>> overreaching(pugi::xml_node net) {
    const std::map<std::string, Lane> lanes = lanes_of(net);
    const auto find = [&](std::string_view edge, std::string_view lane) {
        const auto found = lanes.find(fmt::format("{}{}", edge, lane));
        return found == lanes.end() || found->second.line.size() < 2 ? nullptr : &found->second;
    };
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const pugi::xml_node each : net.children("connection")) {
        const auto text = [&](const char* name) {
            return std::string(each.attribute(name).value());
        };
        const Lane* from = find(text("from"), "_" + text("fromLane"));
        const Lane* to = find(text("to"), "_" + text("toLane"));
        const Lane* via = find(text("via"), "");
        if (from == nullptr || to == nullptr || via == nullptr || text("dir") == "t")
            continue;
        const std::size_t end = from->line.size() - 1, way = via->line.size() - 1;
        const double off = direction(from->line[end - 1], from->line[end])
                               .dot(direction(via->line[0], via->line[1]));
        const double onto =
            direction(via->line[way - 1], via->line[way]).dot(direction(to->line[0], to->line[1]));
        const bool first_is_short = from->length < to->length;
        if (std::max(off, onto) < against)
            pairs.emplace_back(from->edge.attribute("to").value(),
                               first_is_short ? from->edge.attribute("from").value()
                                              : to->edge.attribute("to").value());
    }
    return pairs;
}

/// What a junction of the network was made of. Empty: something that netconvert made up.
JunctionIds members(const std::string& junction, const std::vector<JunctionIds>& joins) {
    constexpr std::string_view cluster = "cluster_";
    if (!junction.starts_with(cluster))
        return {junction};
    // It names the first few; the last may be "#7more".
    JunctionIds named;
    std::size_t begin = cluster.size();
    while (begin < junction.size()) {
        const std::size_t end = std::min(junction.find('_', begin), junction.size());
        if (junction[begin] != '#')
            named.push_back(junction.substr(begin, end - begin));
        begin = end + 1;
    }
    for (const JunctionIds& join : joins)
        if (std::all_of(named.begin(), named.end(), [&](const std::string& id) {
                return std::find(join.begin(), join.end(), id) != join.end();
            }))
            return join;
    return {};
}

}  // namespace

std::size_t merges_in(const std::vector<JunctionIds>& joins) {
    std::size_t merges = 0;
    for (const JunctionIds& join : joins)
        merges += join.empty() ? 0 : join.size() - 1;
    return merges;
}

std::vector<JunctionIds> read_joins(const std::string& xml) {
    pugi::xml_document document;
    document.load_buffer(xml.data(), xml.size());
    std::vector<JunctionIds> joins;
    for (const pugi::xml_node join : document.child("nodes").children("join")) {
        const auto ids = world::words(join.attribute("nodes").value());
        joins.emplace_back(ids.begin(), ids.end());
    }
    return joins;
}

std::string joins_xml(const std::vector<JunctionIds>& joins) {
    std::string xml = "<nodes>\n";
    for (const JunctionIds& ids : joins)
        xml += fmt::format("<join nodes=\"{}\"/>\n", fmt::join(ids, " "));
    return xml + "</nodes>\n";
}

std::vector<JunctionIds> with_overreaching(std::vector<JunctionIds> joins,
                                           const std::string& network) {
    pugi::xml_document document;
    document.load_buffer(network.data(), network.size());
    for (const auto& [one, other] : overreaching(document.child("net"))) {
        const JunctionIds first = members(one, joins), second = members(other, joins);
        if (one == other || first.empty() || second.empty())
            continue;
        std::set<std::string> all(first.begin(), first.end());
        all.insert(second.begin(), second.end());
        std::vector<JunctionIds> others;
        for (const JunctionIds& join : joins)
            if (std::any_of(
                    join.begin(), join.end(), [&](const auto& id) { return all.contains(id); }))
                all.insert(join.begin(), join.end());
            else
                others.push_back(join);
        joins = std::move(others);
        joins.emplace_back(all.begin(), all.end());
    }
    return joins;
}

}  // namespace reprise::towns
