#include "towns/import/signal_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include <pugixml.hpp>

#include "towns/check/furniture_check.h"
#include "towns/network/lanes.h"
#include "towns/network/links.h"
#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/town.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::LaneKind;
using world::LaneT;
using world::Vec3;
using Kind = RoadSignal::Kind;

constexpr double pi = std::numbers::pi;
constexpr double sixty_degrees = pi / 3;

Vector2d flat(const Vec3& point) {
    return {point.x(), point.y()};
}

Eigen::Vector3d vector(const Vec3& point) {
    return {point.x(), point.y(), point.z()};
}

/// The driving lane of that direction whose kerb side the point is on, not far away.
std::optional<std::uint32_t> lane_beside(const world::TownT& town, const Vec3& point, double yaw) {
    constexpr double farthest = 12, over_the_lane = 0.5;  // [m]
    const double kerb_side = town.left_hand ? 1 : -1;
    std::optional<std::uint32_t> found;
    double nearest = farthest;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != LaneKind::driving)
            continue;
        const world::LaneProjection at = world::project(town.lanes[i], vector(point));
        const double lane_yaw = world::point_at(town.lanes[i], at.s).yaw;
        if (at.distance < nearest && at.t * kerb_side > -over_the_lane &&
            std::abs(world::wrap_angle(lane_yaw - yaw)) < sixty_degrees) {
            nearest = at.distance;
            found = i;
        }
    }
    return found;
}

/// One of the two readings of a signal's heading, as the way of those who read it.
double read_yaw(const RoadSignal& signal, bool relative_to_orientation) {
    return world::wrap_angle(signal.heading + (relative_to_orientation && signal.against ? pi : 0));
}

std::vector<SignalSite> site_as(const OpenDrive& map, const ImportedRoads& roads, bool relative) {
    const Vector2d offset = offset_of(map, roads);
    std::vector<SignalSite> sites;
    for (const RoadSignal& signal : map.signals) {
        SignalSite site;
        site.signal = &signal;
        site.foot = {signal.foot.x() + offset.x(), signal.foot.y() + offset.y(), signal.foot.z()};
        site.yaw = read_yaw(signal, relative);
        site.lane = lane_beside(roads.town, site.foot, site.yaw);
        sites.push_back(site);
    }
    return sites;
}

/// The lights that netconvert gave to each link of each program.
using Lights = std::map<std::pair<std::string, std::uint32_t>, std::vector<std::string>>;

Lights read_lights(const pugi::xml_node& net) {
    Lights lights;
    for (const pugi::xml_node connection : net.children("connection")) {
        const pugi::xml_attribute program = connection.attribute("tl");
        if (!program)
            continue;
        for (const pugi::xml_node param : connection.children("param"))
            if (std::string_view(param.attribute("key").value()) == "signalID")
                for (const std::string_view id : world::words(param.attribute("value").value()))
                    lights[{program.value(), connection.attribute("linkIndex").as_uint()}]
                        .emplace_back(id);
    }
    return lights;
}

// ---- placing ----------------------------------------------------------------------------------

bool on_the_road(const world::TownT& town, const Vec3& point) {
    constexpr double pole_radius = 0.3;
    return std::any_of(town.lanes.begin(), town.lanes.end(), [&](const LaneT& lane) {
        return world::is_for_cars(lane) &&
               world::project(lane, vector(point)).distance < lane.width / 2 + pole_radius;
    });
}

/// Is it in the middle of a sidewalk or crossing?
bool in_the_way_of_walkers(const world::TownT& town, const Vec3& point) {
    constexpr double pole_radius = 0.2, way = towns::walker_clearance + pole_radius;  // [m]
    return std::any_of(town.lanes.begin(), town.lanes.end(), [&](const LaneT& lane) {
        return (lane.kind == LaneKind::sidewalk || lane.kind == LaneKind::crossing) &&
               world::project(lane, vector(point)).distance < way;
    });
}

/// The foot, moved to the right of those who read the signal; in left-hand traffic to the left.
Vec3 moved(const SignalSite& site, double way, bool left_hand) {
    const double side = site.yaw + (left_hand ? pi / 2 : -pi / 2);
    return {
        site.foot.x() + way * std::cos(side), site.foot.y() + way * std::sin(side), site.foot.z()};
}

/// How far that must be so that no road is there; nothing when there is road everywhere. Where the
/// map's own place is no road it stays, whoever walks there.
std::optional<double> way_to_kerb(const world::TownT& town, const SignalSite& site) {
    constexpr double farthest = 15, step = 0.25;  // [m]
    for (int i = 0; i * step <= farthest; ++i) {
        const Vec3 foot = moved(site, i * step, town.left_hand);
        if (!on_the_road(town, foot) && (i == 0 || !in_the_way_of_walkers(town, foot)))
            return i * step;
    }
    return std::nullopt;
}

/// How badly a light suits those who stop at a lane's end; nothing when they cannot see it.
std::optional<double> distance_to(const SignalSite& site, const world::SignalT& signal) {
    const Vector2d off = flat(site.foot) - flat(signal.position);
    const Vector2d ahead(std::cos(signal.yaw), std::sin(signal.yaw));
    const double along = off.dot(ahead);
    const double across = ahead.x() * off.y() - ahead.y() * off.x();
    const bool seen = std::abs(world::wrap_angle(site.yaw - signal.yaw)) < sixty_degrees &&
                      along > -12 && along < 45 && std::abs(across) < 15;
    return seen ? std::optional(off.norm()) : std::nullopt;
}

/// Signals of a lane's links, by program and lane: they share a head.
using LaneSignals = std::map<std::pair<std::string, std::uint32_t>, std::vector<std::uint32_t>>;

LaneSignals signals_by_lane(const world::TownT& town) {
    LaneSignals lanes;
    for (std::uint32_t i = 0; i < town.signals.size(); ++i)
        if (const std::uint32_t lane = town.signals[i].lane;
            lane != world::none && town.lanes[lane].kind == LaneKind::driving)
            lanes[{town.signals[i].program, town.signals[i].lane}].push_back(i);
    return lanes;
}

/// Does it hang over the end of the lane itself, which is `width` wide?
bool hangs_over(const SignalSite& site, const world::SignalT& signal, double width) {
    constexpr double farthest = 12;  // [m] netconvert makes junctions of another size
    const Vector2d off = flat(site.foot) - flat(signal.position);
    const double across = std::cos(signal.yaw) * off.y() - std::sin(signal.yaw) * off.x();
    return std::abs(across) < width / 2 && off.norm() < farthest;
}

/// The nearest of those lights that can be seen from a lane's end. One that hangs over the lane is
/// its own, whatever netconvert ties to it.
std::optional<std::size_t> nearest_light(const std::vector<SignalSite>& sites,
                                         const world::SignalT& signal,
                                         double lane_width,
                                         const std::set<std::string>& ids) {
    constexpr double nearby = 15;  // [m] for a light that netconvert has not tied to the lane
    std::optional<std::tuple<bool, double, std::size_t>> best;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (sites[i].signal->kind != Kind::light)
            continue;
        const std::optional<double> far = distance_to(sites[i], signal);
        if (!far)
            continue;
        const bool over = hangs_over(sites[i], signal, lane_width);
        const bool tied = ids.empty() ? *far < nearby : ids.count(sites[i].signal->id) > 0;
        if ((over || tied) && (!best || std::tuple(!over, *far, i) < *best))
            best = {!over, *far, i};
    }
    return best ? std::optional(std::get<2>(*best)) : std::nullopt;
}

/// Links that a light stands for. Key: index of the site, and the program.
using LightLinks = std::map<std::pair<std::size_t, std::string>, std::vector<std::uint32_t>>;

/// Does a light that shows something stand there already, for the same drivers? netconvert, for
/// one, writes a light for each link of a lane.
bool stands_at_another(const std::vector<SignalSite>& sites,
                       std::size_t index,
                       const LightLinks& links) {
    constexpr double same_place = 1;  // [m]
    const SignalSite& site = sites[index];
    return std::any_of(links.begin(), links.end(), [&](const auto& entry) {
        const SignalSite& other = sites[entry.first.first];
        return (flat(other.foot) - flat(site.foot)).norm() < same_place &&
               std::abs(world::wrap_angle(other.yaw - site.yaw)) < sixty_degrees;
    });
}

/// netconvert ties lights to links, at times those of the other side of the road as well, at times
/// none: of those, or else of all, the nearest that can be seen counts.
LightLinks lights_of_links(const std::vector<SignalSite>& sites, const ImportedRoads& roads) {
    LightLinks found;
    for (const auto& [key, signals] : signals_by_lane(roads.town)) {
        std::set<std::string> ids;
        for (const std::uint32_t signal : signals)
            ids.insert(roads.lights[signal].begin(), roads.lights[signal].end());
        const auto light = nearest_light(
            sites, roads.town.signals[signals.front()], roads.town.lanes[key.second].width, ids);
        for (const std::uint32_t signal : signals)
            if (light)
                found[{*light, key.first}].push_back(roads.town.signals[signal].index);
    }
    return found;
}

Place::Head head_at(const SignalSite& site, double way, bool left_hand) {
    constexpr double at_kerb = 3.2, over_road = 5.2, lowest = 2.0;
    Place::Head head;
    head.foot = moved(site, way, left_hand);
    head.yaw = site.yaw;
    head.arm = left_hand ? -way : way;
    // RoadRunner gives the foot of the post where the standard wants the lower edge.
    const double middle = site.signal->bottom + site.signal->height / 2;
    head.height = site.signal->bottom > lowest ? middle : at_kerb;
    if (way > 1)
        head.height = std::max(head.height, over_road);
    return head;
}

world::Prop sign_at(const SignalSite& site, double way, bool left_hand) {
    constexpr double height = 2.4;
    const world::PropKind kind = site.signal->kind == Kind::stop ? world::PropKind::stop_sign
                                 : site.signal->kind == Kind::yield
                                     ? world::PropKind::yield_sign
                                     : world::PropKind::speed_limit_sign;
    return {moved(site, way, left_hand),
            site.yaw,
            0,
            0,
            height,
            0,
            static_cast<std::uint16_t>(std::lround(site.signal->limit_kmh)),
            kind,
            0};
}

}  // namespace

ImportedRoads read_roads(const std::string& network, const std::string& file) {
    pugi::xml_document document;
    if (!document.load_buffer(network.data(), network.size()))
        throw world::Error(file + ": is not a SUMO network");
    const pugi::xml_node net = document.child("net");
    ImportedRoads roads;
    roads.town.left_hand = net.attribute("lefthand").as_bool();
    read_junctions(net, roads.town);
    read_lanes(net, roads.town);
    read_links(net, roads.town);
    const pugi::xml_node location = net.child("location");
    const std::vector<Vec3> offset = parse_shape(location.attribute("netOffset").value());
    if (!offset.empty())
        roads.offset = flat(offset.front());
    roads.projected = std::string_view(location.attribute("projParameter").value()) != "!";
    const Lights lights = read_lights(net);
    for (const world::SignalT& signal : roads.town.signals) {
        const auto found = lights.find({signal.program, signal.index});
        roads.lights.push_back(found == lights.end() ? std::vector<std::string>() : found->second);
    }
    return roads;
}

Vector2d offset_of(const OpenDrive& map, const ImportedRoads& roads) {
    return roads.projected ? Vector2d(roads.offset - map.origin) : roads.offset;
}

std::vector<SignalSite> site_signals(const OpenDrive& map, const ImportedRoads& roads) {
    std::vector<SignalSite> relative = site_as(map, roads, true);
    std::vector<SignalSite> plain = site_as(map, roads, false);
    const auto fit = [](const std::vector<SignalSite>& sites) {
        return std::count_if(sites.begin(), sites.end(), [](const SignalSite& site) {
            return site.lane.has_value();
        });
    };
    return fit(relative) >= fit(plain) ? relative : plain;
}

SignalReport place_signals(const OpenDrive& map, const ImportedRoads& roads, Place& place) {
    const bool left_hand = roads.town.left_hand;
    const std::vector<SignalSite> sites = site_signals(map, roads);
    const auto links = lights_of_links(sites, roads);
    SignalReport report;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const bool is_light = sites[i].signal->kind == Kind::light;
        report.lights += is_light ? 1 : 0;
        const std::optional<double> way = way_to_kerb(roads.town, sites[i]);
        const auto first = links.lower_bound({i, ""});
        const bool useful = !is_light || (first != links.end() && first->first.first == i);
        if (!way || !useful) {
            ++(is_light && stands_at_another(sites, i, links) ? report.shared : report.lost);
            continue;
        }
        report.moved += *way > 0 ? 1 : 0;
        if (!is_light) {
            place.signs.push_back(sign_at(sites[i], *way, left_hand));
            ++report.signs;
            continue;
        }
        for (auto at = first; at != links.end() && at->first.first == i; ++at) {
            Place::Head head = head_at(sites[i], *way, left_hand);
            head.program = at->first.second;
            head.links = at->second;
            std::sort(head.links.begin(), head.links.end());
            place.heads.push_back(head);
        }
        ++report.heads;
    }
    return report;
}

}  // namespace reprise::towns
