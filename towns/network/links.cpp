#include "towns/network/links.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "world/tick.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using world::LaneKind;
using world::LaneT;
using world::none;
using world::TownT;

struct Connection {
    std::uint32_t from = none;
    std::uint32_t to = none;
    std::uint32_t via = none;
    world::Turn turn = world::Turn::straight;
    bool yields = false;
    std::string program;  ///< empty: no traffic light
    std::uint32_t index = 0;
};

world::Turn turn_of(char direction) {
    switch (direction) {
        case 'l':
            return world::Turn::left;
        case 'r':
            return world::Turn::right;
        case 'L':
            return world::Turn::partially_left;
        case 'R':
            return world::Turn::partially_right;
        case 't':
        case 'T':
            return world::Turn::around;
        default:
            return world::Turn::straight;
    }
}

/// SUMO's link states: minor road, stop sign, all-way stop, equal (priority to the right).
bool must_yield(char state) {
    return state == 'm' || state == 's' || state == 'w' || state == '=';
}

std::uint32_t lane_of(const TownT& town, const pugi::xml_node& connection, bool source) {
    const char* edge = connection.attribute(source ? "from" : "to").value();
    const char* index = connection.attribute(source ? "fromLane" : "toLane").value();
    return world::find_lane(town, fmt::format("{}_{}", edge, index)).value_or(none);
}

/// Both ends exist, and cars are not led onto ground that is not for cars.
bool leads_on(const TownT& town, const Connection& connection) {
    if (connection.from == none || connection.to == none)
        return false;
    if (!world::is_for_cars(town.lanes[connection.from]))
        return true;
    return world::is_for_cars(town.lanes[connection.to]) &&
           (connection.via == none || world::is_for_cars(town.lanes[connection.via]));
}

std::vector<Connection> read_connections(const pugi::xml_node& net, const TownT& town) {
    std::vector<Connection> connections;
    for (const pugi::xml_node xml : net.children("connection")) {
        Connection connection;
        connection.from = lane_of(town, xml, true);
        connection.to = lane_of(town, xml, false);
        if (const pugi::xml_attribute via = xml.attribute("via"))
            connection.via = world::find_lane(town, via.value()).value_or(none);
        if (!leads_on(town, connection))
            continue;
        connection.turn = turn_of(*xml.attribute("dir").value());
        connection.yields = must_yield(*xml.attribute("state").value());
        if (xml.attribute("linkIndex")) {
            connection.program = xml.attribute("tl").value();
            connection.index = xml.attribute("linkIndex").as_uint();
        }
        connections.push_back(std::move(connection));
    }
    std::stable_sort(connections.begin(), connections.end(), [](const auto& p, const auto& q) {
        return std::tie(p.from, p.to, p.via) < std::tie(q.from, q.to, q.via);
    });
    return connections;
}

/// Cars read a signal at the end of their lane; walkers at the start of the crossing, which is the
/// lane that such a signal faces.
world::SignalT make_signal(const TownT& town, const Connection& connection) {
    world::SignalT signal;
    signal.program = connection.program;
    signal.index = connection.index;
    signal.for_walkers = town.lanes[connection.to].kind == LaneKind::crossing;
    signal.lane = signal.for_walkers ? connection.to : connection.from;
    const LaneT& lane = town.lanes[signal.lane];
    const world::LanePoint point = world::point_at(lane, signal.for_walkers ? 0 : lane.length);
    signal.position = world::Vec3(point.position.x(), point.position.y(), point.position.z());
    signal.yaw = point.yaw;
    return signal;
}

}  // namespace

void read_links(const pugi::xml_node& net, TownT& town) {
    const std::vector<Connection> connections = read_connections(net, town);

    // Signals first, because links name them by index. Links that share a light share its first
    // pose.
    std::map<std::pair<std::string, std::uint32_t>, const Connection*> lights;
    for (const Connection& connection : connections)
        if (!connection.program.empty())
            lights.emplace(std::pair{connection.program, connection.index}, &connection);
    std::map<std::pair<std::string, std::uint32_t>, std::uint32_t> signals;
    for (const auto& [key, first] : lights) {
        signals[key] = static_cast<std::uint32_t>(town.signals.size());
        town.signals.push_back(make_signal(town, *first));
    }

    for (const Connection& connection : connections) {
        const auto signal = signals.find({connection.program, connection.index});
        town.lanes[connection.from].links.emplace_back(
            connection.to,
            connection.via,
            signal == signals.end() ? none : signal->second,
            connection.turn,
            connection.yields,
            std::uint16_t{0});
    }
}

}  // namespace reprise::towns
