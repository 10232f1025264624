#include "towns/town_reader.h"

#include <algorithm>
#include <limits>
#include <string>

#include <pugixml.hpp>

#include "ground/mesh/level_paths.h"
#include "towns/network/lanes.h"
#include "towns/network/links.h"
#include "towns/network/network_xml.h"
#include "towns/scenery.h"
#include "world/check.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

/// The box around all lanes, their width included.
void measure(world::TownT& town) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
    Eigen::Vector3d high = -low;
    for (const world::LaneT& lane : town.lanes)
        for (const world::Vec3& point : lane.outline.empty() ? lane.centre : lane.outline) {
            const double half = lane.outline.empty() ? lane.width / 2 : 0;
            const Eigen::Vector3d margin(half, half, 0);
            const Eigen::Vector3d p(point.x(), point.y(), point.z());
            low = low.cwiseMin(p - margin);
            high = high.cwiseMax(p + margin);
        }
    town.low = world::Vec3(low.x(), low.y(), low.z());
    town.high = world::Vec3(high.x(), high.y(), high.z());
}

/// The network's element; the document keeps it.
pugi::xml_node parse(const Network& network, pugi::xml_document& document) {
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.xml.data(), network.xml.size());
    const pugi::xml_node net = document.child("net");
    if (!parsed || !net)
        throw world::Error(
            network.name + ".net.xml:" +
            std::to_string(line_of(network.xml, static_cast<std::size_t>(parsed.offset))) +
            ": is not a SUMO network");
    return net;
}

world::TownT streets_of(const pugi::xml_node& net, const Network& network) {
    world::TownT town;
    town.name = network.name;
    town.left_hand = net.attribute("lefthand").as_bool();
    read_junctions(net, town);
    read_lanes(net, town);
    const bool drivable = std::any_of(town.lanes.begin(), town.lanes.end(), [](const auto& lane) {
        return lane.kind == world::LaneKind::driving;
    });
    if (!drivable)
        throw world::Error(network.name + ".net.xml:1: has no lane that a passenger car may use");
    ground::level_paths(town);
    return town;
}

}  // namespace

world::TownT read_streets(const Network& network) {
    pugi::xml_document document;
    return streets_of(parse(network, document), network);
}

world::TownT read_town(const Network& network) {
    pugi::xml_document document;
    const pugi::xml_node net = parse(network, document);
    world::TownT town = streets_of(net, network);
    read_links(net, town);
    const Place place =
        network.place.empty() ? Place() : read_place(network.place, network.name + ".place.xml");
    measure(town);
    place_scenery(town, place, read_give_way(net, town));
    return town;
}

}  // namespace reprise::towns
