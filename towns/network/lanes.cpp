#include "towns/network/lanes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/lanes/road_place.h"
#include "world/models/vehicle_classes.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using world::LaneKind;
using world::LaneT;
using world::none;
using world::TownT;
using world::Vec3;

constexpr double default_width = 3.2;  // SUMO's, where the network says nothing

double distance(const Vec3& p, const Vec3& q) {
    return std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
}

double length_of(const std::vector<Vec3>& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += distance(line[i - 1], line[i]);
    return length;
}

double signed_area(const std::vector<Vec3>& polygon) {
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& p = polygon[i];
        const Vec3& q = polygon[(i + 1) % polygon.size()];
        area += p.x() * q.y() - q.x() * p.y();
    }
    return area / 2;
}

void make_counter_clockwise(std::vector<Vec3>& polygon) {
    if (signed_area(polygon) < 0)
        std::reverse(polygon.begin(), polygon.end());
}

/// Lanes of no length occur; a centre line has two points all the same.
void ensure_two_points(std::vector<Vec3>& line) {
    if (line.empty())
        line.emplace_back(0, 0, 0);
    if (line.size() == 1)
        line.emplace_back(line[0].x() + 0.01, line[0].y(), line[0].z());
}

/// The two corners that lie farthest from each other, in their order: a walking area has no centre
/// line of its own, and this one at least crosses it.
std::vector<Vec3> longest_diagonal(const std::vector<Vec3>& polygon) {
    std::pair<std::size_t, std::size_t> best{0, 0};
    double longest = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        for (std::size_t j = i + 1; j < polygon.size(); ++j)
            if (distance(polygon[i], polygon[j]) > longest) {
                longest = distance(polygon[i], polygon[j]);
                best = {i, j};
            }
    if (longest == 0)
        return polygon;
    return {polygon[best.first], polygon[best.second]};
}

LaneKind kind_of(std::string_view function, world::ClassSet classes) {
    static const world::ClassSet motor = world::class_bit("passenger") | world::class_bit("bus") |
                                         world::class_bit("delivery") | world::class_bit("truck") |
                                         world::class_bit("tram") | world::class_bit("rail") |
                                         world::class_bit("rail_urban") | world::class_bit("ship");
    if (function == "crossing")
        return LaneKind::crossing;
    if (function == "walkingarea")
        return LaneKind::walking_area;
    if ((classes & world::class_bit("passenger")) != 0)
        return function == "internal" ? LaneKind::internal : LaneKind::driving;
    const bool for_walkers =
        (classes & world::class_bit("pedestrian")) != 0 && (classes & motor) == 0;
    return for_walkers && function != "internal" ? LaneKind::sidewalk : LaneKind::other;
}

void read_geometry(const pugi::xml_node& lane_xml, LaneT& lane) {
    lane.width = number(lane_xml.attribute("width").value(), default_width);
    if (lane.width <= 0)
        lane.width = default_width;
    lane.centre = parse_shape(lane_xml.attribute("shape").value());
    if (lane.kind == LaneKind::walking_area) {
        lane.outline = lane.centre;
        make_counter_clockwise(lane.outline);
        lane.centre = longest_diagonal(lane.outline);
    }
    ensure_two_points(lane.centre);
    if (lane.kind == LaneKind::crossing) {
        lane.outline = parse_shape(lane_xml.attribute("outlineShape").value());
        if (lane.outline.size() < 3) {
            lane.outline = offset_line(lane.centre, -lane.width / 2);
            const std::vector<Vec3> left = offset_line(lane.centre, lane.width / 2);
            lane.outline.insert(lane.outline.end(), left.rbegin(), left.rend());
        }
        make_counter_clockwise(lane.outline);
    }
    lane.length = length_of(lane.centre);
    lane.sumo_length = number(lane_xml.attribute("length").value(), lane.length);
    if (lane.sumo_length <= 0)
        lane.sumo_length = lane.length;
}

std::uint32_t find_junction(const TownT& town, const std::string& name) {
    const auto found = std::lower_bound(town.junctions.begin(),
                                        town.junctions.end(),
                                        name,
                                        [](const world::JunctionT& junction,
                                           const std::string& key) { return junction.name < key; });
    if (found == town.junctions.end() || found->name != name)
        return none;
    return static_cast<std::uint32_t>(found - town.junctions.begin());
}

LaneT read_lane(const pugi::xml_node& edge, const pugi::xml_node& lane_xml, const TownT& town) {
    LaneT lane;
    lane.name = lane_xml.attribute("id").value();
    lane.edge = edge.attribute("id").value();
    const world::ClassSet classes = world::permitted(lane_xml.attribute("allow").value(),
                                                     lane_xml.attribute("disallow").value());
    lane.kind = kind_of(edge.attribute("function").value(), classes);
    lane.index = static_cast<std::uint8_t>(lane_xml.attribute("index").as_uint());
    read_geometry(lane_xml, lane);
    lane.speed_limit = number(lane_xml.attribute("speed").value(), 13.89);
    lane.left = lane.right = lane.opposite = none;
    const bool inside = !lane.edge.empty() && lane.edge.front() == ':';
    if (!inside)
        lane.street = edge.attribute("name").value();
    const pugi::xml_node road = lane_xml.find_child_by_attribute("param", "key", "road");
    world::set_road_pieces(lane, world::read_road_pieces(road.attribute("value").value()));
    lane.junction =
        find_junction(town, inside ? junction_around(lane.edge) : edge.attribute("to").value());
    return lane;
}

/// Lanes of one edge lie next to each other in the sorted list, but "_10" sorts before "_2".
void link_neighbours(TownT& town) {
    std::map<std::pair<std::string, int>, std::uint32_t> by_place;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (town.lanes[i].kind == LaneKind::driving)
            by_place[{town.lanes[i].edge, town.lanes[i].index}] = i;
    for (const auto& [place, lane] : by_place) {
        const auto inner = by_place.find({place.first, place.second + 1});
        if (inner == by_place.end())
            continue;
        // Index 0 is at the kerb: on the right, or on the left where one drives on the left.
        if (town.left_hand) {
            town.lanes[lane].right = inner->second;
            town.lanes[inner->second].left = lane;
        } else {
            town.lanes[lane].left = inner->second;
            town.lanes[inner->second].right = lane;
        }
    }
}

/// Old networks have lanes of 3.2 m every 3.3 m: grass would grow between them.
void close_slits(TownT& town) {
    constexpr double rounding = 0.02, widest = 0.3;  // [m]
    std::map<std::pair<std::string, int>, std::uint32_t> by_place;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (town.lanes[i].kind == LaneKind::driving || town.lanes[i].kind == LaneKind::other)
            by_place[{town.lanes[i].edge, town.lanes[i].index}] = i;
    std::vector<double> wider(town.lanes.size(), 0.0);
    for (const auto& [place, i] : by_place) {
        const auto inner = by_place.find({place.first, place.second + 1});
        if (inner == by_place.end())
            continue;
        const LaneT& lane = town.lanes[i];
        const LaneT& other = town.lanes[inner->second];
        const auto middle = world::point_at(lane, lane.length / 2).position;
        const double slit = world::project(other, middle).distance - (lane.width + other.width) / 2;
        if (slit > rounding && slit < widest)
            for (const std::uint32_t each : {i, inner->second})
                wider[each] = std::max(wider[each], slit);
    }
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        town.lanes[i].width += wider[i];
}

bool touches(const LaneT& lane, const LaneT& other) {
    const double side_by_side = (lane.width + other.width) / 2;
    constexpr double slack = 0.8;
    return std::abs(distance(lane.centre.front(), other.centre.back()) - side_by_side) < slack &&
           std::abs(distance(lane.centre.back(), other.centre.front()) - side_by_side) < slack;
}

/// The network's own word (<neigh>), or else the reversed edge between the same two nodes.
void link_opposites(const pugi::xml_node& net, TownT& town) {
    std::map<std::pair<std::string, std::string>, std::vector<std::uint32_t>> innermost;
    for (const pugi::xml_node edge : net.children("edge")) {
        std::optional<std::uint32_t> last;
        for (const pugi::xml_node lane_xml : edge.children("lane")) {
            const auto lane = world::find_lane(town, lane_xml.attribute("id").value());
            if (lane && world::is_for_cars(town.lanes[*lane]))
                last = lane;
            const pugi::xml_attribute neigh = lane_xml.child("neigh").attribute("lane");
            const auto other = neigh ? world::find_lane(town, neigh.value()) : std::nullopt;
            if (lane && other)
                town.lanes[*lane].opposite = *other;
        }
        if (last && town.lanes[*last].kind == LaneKind::driving)
            innermost[{edge.attribute("from").value(), edge.attribute("to").value()}].push_back(
                *last);
    }
    for (const auto& [nodes, lanes] : innermost) {
        const auto reversed = innermost.find({nodes.second, nodes.first});
        if (reversed == innermost.end())
            continue;
        for (const std::uint32_t lane : lanes)
            for (const std::uint32_t other : reversed->second)
                if (town.lanes[lane].opposite == none && lane != other &&
                    touches(town.lanes[lane], town.lanes[other]))
                    town.lanes[lane].opposite = other;
    }
}

}  // namespace

std::vector<Vec3> offset_line(const std::vector<Vec3>& centre, double offset) {
    std::vector<Vec3> moved;
    moved.reserve(centre.size());
    auto left_normal = [&](std::size_t from) {
        const Vec3& p = centre[from];
        const Vec3& q = centre[from + 1];
        const double length = std::hypot(q.x() - p.x(), q.y() - p.y());
        return length > 0 ? std::pair{(p.y() - q.y()) / length, (q.x() - p.x()) / length}
                          : std::pair{0.0, 0.0};
    };
    for (std::size_t i = 0; i < centre.size(); ++i) {
        const auto before = left_normal(i > 0 ? i - 1 : 0);
        const auto after = left_normal(i + 1 < centre.size() ? i : i - 1);
        double x = before.first + after.first;
        double y = before.second + after.second;
        // (before + after) / (1 + before . after) reaches the corner where both sides meet.
        const double cosine = before.first * after.first + before.second * after.second;
        const double mitre = 1 / std::max(0.5, 1 + cosine);
        x *= mitre * offset;
        y *= mitre * offset;
        moved.emplace_back(centre[i].x() + x, centre[i].y() + y, centre[i].z());
    }
    return moved;
}

void read_junctions(const pugi::xml_node& net, TownT& town) {
    for (const pugi::xml_node junction_xml : net.children("junction")) {
        const std::string_view type = junction_xml.attribute("type").value();
        if (type == "internal")
            continue;
        world::JunctionT junction;
        junction.name = junction_xml.attribute("id").value();
        junction.outline = parse_shape(junction_xml.attribute("shape").value());
        if (junction.outline.size() > 1 &&
            distance(junction.outline.front(), junction.outline.back()) < 1e-3)
            junction.outline.pop_back();
        junction.centre = Vec3(number(junction_xml.attribute("x").value(), 0),
                               number(junction_xml.attribute("y").value(), 0),
                               number(junction_xml.attribute("z").value(), 0));
        junction.lit = type.starts_with("traffic_light");
        town.junctions.push_back(std::move(junction));
    }
    std::sort(town.junctions.begin(), town.junctions.end(), [](const auto& p, const auto& q) {
        return p.name < q.name;
    });
}

void read_lanes(const pugi::xml_node& net, TownT& town) {
    for (const pugi::xml_node edge : net.children("edge")) {
        // Macroscopic connectors have lanes, but nothing that one could drive on.
        if (std::string_view(edge.attribute("function").value()) == "connector")
            continue;
        for (const pugi::xml_node lane_xml : edge.children("lane"))
            town.lanes.push_back(read_lane(edge, lane_xml, town));
    }
    std::sort(town.lanes.begin(), town.lanes.end(), [](const LaneT& p, const LaneT& q) {
        return p.name < q.name;
    });
    link_neighbours(town);
    close_slits(town);
    link_opposites(net, town);
}

}  // namespace reprise::towns
