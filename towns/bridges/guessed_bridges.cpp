// Must: find every place where two roads for cars cross without a junction, and say which one is
// up. Assumes: the network is XML; a road and its way back lie side by side. Goes: centre lines in
// pieces; those that cut each other; a stretch of the upper road around each
//   such place becomes a way with a layer: one more than what it passes over has there.
// Keeps: the order of the file.
#include "towns/bridges/guessed_bridges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/bridges/pieces.h"
#include "towns/bridges/road_chains.h"
#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/models/vehicle_classes.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;

constexpr double fork_reach = 30;     ///< [m] from a common junction roads cross without a bridge
constexpr double bridge_apron = 8;    ///< [m] of a bridge, on both sides of what it crosses
constexpr double one_lane_width = 5;  ///< [m] wide at most, both directions together
constexpr double least_angle = 0.2;   ///< sine; roads that meet at less touch rather than cross
constexpr double usual_width = 3.2;   ///< [m] SUMO's, where the network says nothing
constexpr int highest = 4;            ///< layers that a map may have

struct BridgeStretch {
    double from = 0, to = 0;  ///< [m] along the road
    int layer = 0;
};

/// An edge for cars.
struct CarRoad {
    std::string way;  ///< its own id, or that of the map's way that it was made of
    std::string from, to;
    world::Loop line;
    double width = 0;
    std::vector<BridgeStretch> bridges;
};

/// Where the upper one of two roads passes over the other.
struct GuessedOverpass {
    std::size_t upper = 0, lower = 0;  ///< roads
    double s = 0, lower_s = 0;         ///< [m] along them
    double reach = 0;                  ///< [m] of the bridge, either way from s
};

bool is_flat_network(const pugi::xml_node& net) {
    for (const pugi::xml_node edge : net.children("edge"))
        for (const pugi::xml_node lane : edge.children("lane"))
            for (const world::Vec3& point : parse_shape(lane.attribute("shape").value()))
                if (point.z() != 0)
                    return false;
    return true;
}

std::optional<CarRoad> read_car_road(const pugi::xml_node& edge) {
    const std::string_view function = edge.attribute("function").value();
    if (!function.empty() && function != "normal")
        return std::nullopt;
    CarRoad road;
    for (const pugi::xml_node lane : edge.children("lane")) {
        const world::ClassSet classes =
            world::permitted(lane.attribute("allow").value(), lane.attribute("disallow").value());
        if ((classes & world::class_bit("passenger")) == 0)
            continue;
        road.width += number(lane.attribute("width").value(), usual_width);
        road.line = world::in_plan(parse_shape(lane.attribute("shape").value()));
    }
    if (road.line.size() < 2)
        return std::nullopt;
    road.from = edge.attribute("from").value();
    road.to = edge.attribute("to").value();
    return road;
}

/// Tells each edge's first lane which way it is of, where it does not say so itself. Returns its
/// id.
std::string name_way(pugi::xml_node edge) {
    pugi::xml_node lane = edge.child("lane");
    pugi::xml_node param = lane.find_child_by_attribute("param", "key", "origId");
    if (!param) {
        param = lane.append_child("param");
        param.append_attribute("key").set_value("origId");
        // Ids may hold what separates words.
        std::string id = edge.attribute("id").value();
        std::replace(id.begin(), id.end(), ' ', '_');
        std::replace(id.begin(), id.end(), '#', '_');
        param.append_attribute("value").set_value(id.c_str());
    }
    const std::string ways = param.attribute("value").value();
    return ways.substr(0, ways.find(' '));
}

class BridgeGuesser {
  public:
    explicit BridgeGuesser(pugi::xml_node net) {
        for (pugi::xml_node edge : net.children("edge"))
            if (std::optional<CarRoad> road = read_car_road(edge)) {
                road->way = name_way(edge);
                roads_.push_back(std::move(*road));
            }
        std::map<std::pair<std::string, std::string>, double> widths;
        for (const CarRoad& road : roads_)
            widths[std::minmax(road.from, road.to)] += road.width;
        for (CarRoad& road : roads_)
            road.width = widths[std::minmax(road.from, road.to)];
    }

    std::vector<MapShape> ways() {
        find_overpasses();
        // What is lower is known first: ramps come last.
        std::stable_sort(overpasses_.begin(), overpasses_.end(), [&](const auto& a, const auto& b) {
            return is_narrow(a.upper) < is_narrow(b.upper);
        });
        for (const GuessedOverpass& overpass : overpasses_)
            build(overpass);
        std::vector<MapShape> ways;
        for (const CarRoad& road : roads_)
            for (const BridgeStretch& bridge : road.bridges)
                ways.push_back(way_of(road, bridge));
        return ways;
    }

  private:
    bool is_narrow(std::size_t road) const { return roads_[road].width <= one_lane_width; }

    /// Within the roads of a junction that they share, one leaves the other.
    bool fork(const CarRoad& one, const CarRoad& other, const Vector2d& place) const {
        for (const auto& [end, at] :
             {std::pair(&one.from, one.line.front()), std::pair(&one.to, one.line.back())})
            if ((*end == other.from || *end == other.to) && (at - place).norm() < fork_reach)
                return true;
        return false;
    }

    void find_overpasses() {
        std::vector<Piece> pieces;
        std::vector<double> starts;  // [m] along the road
        for (std::uint32_t i = 0; i < roads_.size(); ++i) {
            const std::size_t first = pieces.size();
            add_pieces(roads_[i].line, i, "", pieces);
            double s = 0;
            for (std::size_t k = first; k < pieces.size(); ++k) {
                starts.push_back(s);
                s += (pieces[k].to - pieces[k].from).norm();
            }
        }
        const world::BoxGrid by_place = grid_of(pieces);
        for (std::uint32_t i = 0; i < pieces.size(); ++i)
            for (const std::uint32_t k : by_place.near(box_of(pieces[i], 0)))
                if (k > i && pieces[k].owner != pieces[i].owner)
                    take(pieces[i], starts[i], pieces[k], starts[k]);
    }

    void take(const Piece& one, double s, const Piece& other, double other_s) {
        const Vector2d along = one.to - one.from;
        const Vector2d across = other.to - other.from;
        const double turn = world::cross(along, across);
        const double sine = std::abs(turn) / (along.norm() * across.norm());
        if (!(sine > least_angle))
            return;
        const double share = world::cross(other.from - one.from, across) / turn;
        const double other_share = world::cross(other.from - one.from, along) / turn;
        if (share < 0 || share >= 1 || other_share < 0 || other_share >= 1)
            return;
        const CarRoad& road = roads_[one.owner];
        const CarRoad& other_road = roads_[other.owner];
        const Vector2d place = one.from + share * along;
        if (fork(road, other_road, place) || fork(other_road, road, place))
            return;
        s += share * along.norm();
        other_s += other_share * across.norm();
        const auto northward = [](const Vector2d& v) { return std::abs(v.y()) / v.norm(); };
        const bool is_upper = is_narrow(one.owner) != is_narrow(other.owner)
                                  ? is_narrow(one.owner)
                                  : northward(along) > northward(across);
        if (is_upper)
            overpasses_.push_back(
                {one.owner, other.owner, s, other_s, other_road.width / 2 / sine + bridge_apron});
        else
            overpasses_.push_back(
                {other.owner, one.owner, other_s, s, road.width / 2 / sine + bridge_apron});
    }

    void build(const GuessedOverpass& overpass) {
        int layer = 1;
        for (const BridgeStretch& bridge : roads_[overpass.lower].bridges)
            if (overpass.lower_s > bridge.from && overpass.lower_s < bridge.to)
                layer = std::max(layer, std::min(bridge.layer + 1, highest));
        BridgeStretch built{overpass.s - overpass.reach, overpass.s + overpass.reach, layer};
        std::vector<BridgeStretch>& bridges = roads_[overpass.upper].bridges;
        // Bridges that touch are one, as high as the higher.
        std::erase_if(bridges, [&](const BridgeStretch& other) {
            if (other.from > built.to || other.to < built.from)
                return false;
            built = {std::min(built.from, other.from),
                     std::max(built.to, other.to),
                     std::max(built.layer, other.layer)};
            return true;
        });
        bridges.push_back(built);
    }

    static MapShape way_of(const CarRoad& road, const BridgeStretch& bridge) {
        MapShape way{road.way, {{"bridge", "yes"}, {"layer", std::to_string(bridge.layer)}}, {}};
        const double length = plan_length(road.line);
        const double from = std::clamp(bridge.from, 0.0, length);
        const double to = std::clamp(bridge.to, 0.0, length);
        constexpr int parts = 8;
        for (int i = 0; i <= parts; ++i) {
            const Vector2d p =
                point_along(road.line, (from + (to - from) * i / parts) / length).place;
            way.line.emplace_back(p.x(), p.y(), 0);
        }
        return way;
    }

    std::vector<CarRoad> roads_;
    std::vector<GuessedOverpass> overpasses_;
};

}  // namespace

GuessedBridges guess_bridges(const std::string& network) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.data(), network.size(), pugi::parse_full);
    REPRISE_CHECK(parsed, "a network that was loaded is XML");
    pugi::xml_node net = document.child("net");
    GuessedBridges guessed;
    if (!is_flat_network(net))
        return guessed;
    guessed.ways = BridgeGuesser(net).ways();
    std::ostringstream text;
    document.save(text, "    ");
    guessed.network = std::move(text).str();
    return guessed;
}

std::string without_origins(const std::string& network) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(network.data(), network.size(), pugi::parse_full);
    REPRISE_CHECK(parsed, "a network that was raised is XML");
    for (const pugi::xml_node edge : document.child("net").children("edge"))
        for (pugi::xml_node lane : edge.children("lane"))
            lane.remove_child(lane.find_child_by_attribute("param", "key", "origId"));
    std::ostringstream text;
    document.save(text, "    ");
    return std::move(text).str();
}

}  // namespace reprise::towns
