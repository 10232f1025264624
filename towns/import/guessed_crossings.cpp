#include "towns/import/guessed_crossings.h"

#include <algorithm>
#include <map>
#include <sstream>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using Eigen::Vector3d;
using world::LaneKind;

constexpr double nearby = 15;  ///< [m] from a junction's middle to a crossing at it

/// Edges from and to one neighbour.
struct Arm {
    int in = 0;
    int out = 0;
};

/// The roads that meet at each junction, footways as well.
std::map<std::string, int> roads_at_junctions(const pugi::xml_node& net) {
    std::map<std::string, std::map<std::string, Arm>> arms;
    for (const pugi::xml_node edge : net.children("edge")) {
        const std::string from = edge.attribute("from").value(), to = edge.attribute("to").value();
        if (from.empty() || to.empty())
            continue;
        ++arms[from][to].out;
        ++arms[to][from].in;
    }
    std::map<std::string, int> roads;
    for (const auto& [junction, neighbours] : arms)
        for (const auto& [neighbour, arm] : neighbours)
            roads[junction] += std::max(arm.in, arm.out);
    return roads;
}

/// By junction.
std::map<std::string, int> count_crossings(const pugi::xml_node& net) {
    std::map<std::string, int> crossings;
    for (const pugi::xml_node edge : net.children("edge"))
        if (std::string_view(edge.attribute("function").value()) == "crossing")
            ++crossings[junction_around(edge.attribute("id").value())];
    return crossings;
}

bool is_mapped(const Vector3d& place, const std::vector<Vector3d>& mapped) {
    return std::any_of(mapped.begin(), mapped.end(), [&](const Vector3d& crossing) {
        return (crossing - place).norm() < nearby;
    });
}

/// Not a junction of the map, but what netconvert made of several, or of a ramp: when it reads the
/// map again it does not know the name yet.
bool is_made_up(const std::string& junction) {
    return junction.starts_with("cluster") || junction.find("-Added") != std::string::npos;
}

}  // namespace

GuessedCrossings guessed_crossings(const std::string& network,
                                   const std::vector<Vector3d>& mapped) {
    pugi::xml_document document;
    const bool parsed = document.load_buffer(network.data(), network.size());
    REPRISE_CHECK(parsed, "the network that netconvert made is XML");
    const pugi::xml_node net = document.child("net");
    const std::map<std::string, int> roads = roads_at_junctions(net);
    const std::map<std::string, int> crossings = count_crossings(net);
    pugi::xml_document written;
    pugi::xml_node connections = written.append_child("connections");
    GuessedCrossings guessed;
    for (const pugi::xml_node junction : net.children("junction")) {
        const std::string id = junction.attribute("id").value();
        const auto here = crossings.find(id);
        const auto meeting = roads.find(id);
        const bool is_lit =
            std::string_view(junction.attribute("type").value()).starts_with("traffic_light");
        const Vector3d place(number(junction.attribute("x").value(), 0),
                             number(junction.attribute("y").value(), 0),
                             number(junction.attribute("z").value(), 0));
        if (here == crossings.end() || (meeting != roads.end() && meeting->second > 2) || is_lit ||
            is_made_up(id) || is_mapped(place, mapped))
            continue;
        guessed.at_joins += here->second;
        pugi::xml_node crossing = connections.append_child("crossing");
        crossing.append_attribute("node").set_value(id.c_str());
        crossing.append_attribute("discard").set_value("true");
    }
    std::ostringstream text;
    written.save(text, "");
    guessed.connections = std::move(text).str();
    return guessed;
}

std::vector<Vector3d> places_of_crossings(const world::TownT& town) {
    std::vector<Vector3d> places;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::crossing)
            places.push_back(world::point_at(lane, lane.length / 2).position);
    return places;
}

int lost_crossings(const world::TownT& town, const std::vector<Vector3d>& mapped) {
    const world::LaneMap lanes(town);
    constexpr double beside = 2;  // [m] a way may be drawn beside its lanes
    const auto has_crossing = [&](const Vector3d& place) {
        return std::any_of(town.lanes.begin(), town.lanes.end(), [&](const world::LaneT& lane) {
            return lane.kind == LaneKind::crossing && world::project(lane, place).distance < nearby;
        });
    };
    return static_cast<int>(std::count_if(mapped.begin(), mapped.end(), [&](const Vector3d& place) {
        return !lanes.at(place, beside).empty() && !has_crossing(place);
    }));
}

}  // namespace reprise::towns
