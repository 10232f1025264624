#include "world/lanes/junctions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::world {

namespace {

constexpr double one_street =
    35 * std::numbers::pi / 180;       ///< [rad] between both of its directions
constexpr double street_width = 40;    ///< [m] likewise
constexpr double sign_reach = 15;      ///< [m] from the end of the lane
constexpr double crossing_reach = 15;  ///< [m] from where a lane ends or begins

/// The lanes of one edge at the junction.
struct Side {
    Eigen::Vector3d place;  ///< of the leftmost lane's end at the junction
    double yaw = 0;         ///< [rad] out of the junction
    std::vector<std::uint32_t> lanes;
};

LanePoint end_of(const LaneT& lane) {
    return point_at(lane, lane.length);
}

using Edges = std::map<std::string_view, std::vector<std::uint32_t>>;

/// The driving lanes of each edge, from the right.
Edges lanes_by_edge(const TownT& town) {
    Edges edges;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (town.lanes[i].kind == LaneKind::driving)
            edges[town.lanes[i].edge].push_back(i);
    for (auto& [edge, list] : edges)
        std::sort(list.begin(), list.end(), [&](std::uint32_t one, std::uint32_t other) {
            return town.lanes[one].index < town.lanes[other].index;
        });
    return edges;
}

std::vector<Side> sides(const TownT& town,
                        const Edges& edges,
                        const std::set<std::string_view>& names,
                        bool incoming) {
    std::vector<Side> found;
    for (const std::string_view name : names) {
        const std::vector<std::uint32_t>& lanes = edges.at(name);
        const LaneT& leftmost = town.lanes[lanes.back()];
        const LanePoint at = incoming ? end_of(leftmost) : point_at(leftmost, 0);
        const double yaw = incoming ? wrap_angle(at.yaw + std::numbers::pi) : at.yaw;
        found.push_back({at.position, yaw, lanes});
    }
    return found;
}

/// Where drivers on the edge meet a sign: the end of the rightmost lane.
LanePoint sign_place(const TownT& town, const std::vector<std::uint32_t>& lanes) {
    return end_of(town.lanes[lanes.front()]);
}

/// [m] from the end of the road; infinity: it is not for who drives there.
double distance_to(const Prop& sign, const LanePoint& end) {
    const double distance = (to_eigen(sign.position()) - end.position).norm();
    const bool faces = std::abs(wrap_angle(sign.yaw() - end.yaw)) < one_street;
    return faces && distance < sign_reach ? distance : std::numeric_limits<double>::infinity();
}

/// Of all in reach only the last before the sign, or after it, where one leads on to the other: a
/// sign at the end of a short road is none of the road before it.
void note_sign(const TownT& town,
               const Edges& edges,
               const Prop& sign,
               std::set<std::string_view>& found) {
    std::map<std::string_view, double> reached;
    for (const auto& [edge, lanes] : edges) {
        const double distance = distance_to(sign, sign_place(town, lanes));
        if (distance < sign_reach)
            reached.emplace(edge, distance);
    }
    std::set<std::string_view> farther;
    for (const auto& [edge, distance] : reached)
        for (const std::uint32_t lane : edges.at(edge))
            for (const Link& link : town.lanes[lane].links) {
                if (link.to() == none)
                    continue;
                const auto next = reached.find(town.lanes[link.to()].edge);
                if (next != reached.end() && next->first != edge)
                    farther.insert(next->second < distance ? edge : next->first);
            }
    for (const auto& [edge, distance] : reached)
        if (farther.count(edge) == 0)
            found.insert(edge);
}

/// Those at the end of which a stop sign stands. O(roads * signs).
std::set<std::string_view> edges_with_stop_sign(const TownT& town, const Edges& edges) {
    std::set<std::string_view> found;
    for (const Prop& prop : town.props)
        if (prop.kind() == PropKind::stop_sign)
            note_sign(town, edges, prop, found);
    return found;
}

/// Straight on; where no way leads straight on, whichever way.
bool must_give_way(const TownT& town, const std::vector<std::uint32_t>& incoming) {
    bool straight = false;
    bool any = false;
    bool leads_on = false;
    for (const std::uint32_t lane : incoming)
        for (const Link& link : town.lanes[lane].links) {
            const bool yields = link.yields() && link.signal() == none;
            any = any || yields;
            leads_on = leads_on || link.turn() == Turn::straight;
            straight = straight || (link.turn() == Turn::straight && yields);
        }
    return leads_on ? straight : any;
}

JunctionArm arm_of(const TownT& town,
                   const std::set<std::string_view>& signed_edges,
                   const Side& incoming) {
    JunctionArm arm;
    arm.yaw = incoming.yaw;
    arm.incoming = incoming.lanes;
    arm.yields = must_give_way(town, arm.incoming);
    arm.stop_sign = signed_edges.count(town.lanes[arm.incoming.front()].edge) != 0;
    return arm;
}

/// Where a ray from a lane's end, or back from its start, meets the line from a to b. [m]
std::optional<double> reach(const LanePoint& from,
                            double sign,
                            const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b) {
    const Eigen::Vector2d ray = sign * ahead_of(from.yaw);
    const Eigen::Vector2d along = (b - a).head<2>();
    const double turned = cross(ray, along);
    if (std::abs(turned) < 0.5 * along.norm())  // cars go across it, not along
        return std::nullopt;
    const Eigen::Vector2d to_a = (a - from.position).head<2>();
    const double distance = cross(to_a, along) / turned;
    const double share = cross(to_a, ray) / turned;
    // The centre line of a crossing lies up to half its width behind where lanes end.
    if (share < 0 || share > 1 || distance < -3 || distance > crossing_reach)
        return std::nullopt;
    return distance;
}

/// Both directions of a street make one arm.
std::vector<JunctionArm> join(const TownT& town,
                              const std::set<std::string_view>& signed_edges,
                              const std::vector<Side>& arriving,
                              std::vector<Side> leaving) {
    std::vector<JunctionArm> arms;
    for (const Side& side : arriving) {
        JunctionArm& arm = arms.emplace_back(arm_of(town, signed_edges, side));
        auto nearest = leaving.end();
        for (auto other = leaving.begin(); other != leaving.end(); ++other) {
            const double distance = (other->place - side.place).norm();
            if (std::abs(wrap_angle(other->yaw - side.yaw)) < one_street &&
                distance < street_width &&
                (nearest == leaving.end() || distance < (nearest->place - side.place).norm()))
                nearest = other;
        }
        if (nearest == leaving.end())
            continue;
        arm.outgoing = nearest->lanes;
        leaving.erase(nearest);
    }
    for (const Side& side : leaving) {
        JunctionArm& arm = arms.emplace_back();
        arm.yaw = side.yaw;
        arm.outgoing = side.lanes;
    }
    const auto turn = [](double yaw) { return yaw < 0 ? yaw + 2 * std::numbers::pi : yaw; };
    std::stable_sort(
        arms.begin(), arms.end(), [&](const JunctionArm& one, const JunctionArm& other) {
            return turn(one.yaw) < turn(other.yaw);
        });
    return arms;
}

/// Of each lane the crossing that is nearest on its way.
struct OnWay {
    double distance = crossing_reach + 1;
    std::size_t crossing = 0;
};

}  // namespace

std::vector<std::vector<JunctionArm>> arms_of_junctions(const TownT& town) {
    const Edges edges = lanes_by_edge(town);
    const std::set<std::string_view> signed_edges = edges_with_stop_sign(town, edges);
    std::vector<std::set<std::string_view>> into(town.junctions.size());
    std::vector<std::set<std::string_view>> out_of(town.junctions.size());
    for (const LaneT& lane : town.lanes) {
        if (lane.kind != LaneKind::driving || lane.junction == none)
            continue;
        into[lane.junction].insert(lane.edge);
        for (const Link& link : lane.links)
            if (link.to() != none && town.lanes[link.to()].kind == LaneKind::driving)
                out_of[lane.junction].insert(town.lanes[link.to()].edge);
    }
    std::vector<std::vector<JunctionArm>> arms;
    for (std::size_t i = 0; i < town.junctions.size(); ++i)
        arms.push_back(join(town,
                            signed_edges,
                            sides(town, edges, into[i], true),
                            sides(town, edges, out_of[i], false)));
    return arms;
}

std::vector<bool> lanes_with_stop_sign(const TownT& town) {
    std::vector<bool> found(town.lanes.size(), false);
    const Edges edges = lanes_by_edge(town);
    for (const std::string_view edge : edges_with_stop_sign(town, edges))
        for (const std::uint32_t lane : edges.at(edge))
            found[lane] = true;
    return found;
}

std::vector<CrossingPlace> crossings_of(const TownT& town, const LaneMap& lanes) {
    std::vector<char> lit(town.lanes.size(), 0);
    for (const SignalT& signal : town.signals)
        if (signal.lane != none)
            lit[signal.lane] = 1;
    std::vector<CrossingPlace> crossings;
    std::map<std::uint32_t, OnWay> ends;
    std::map<std::uint32_t, OnWay> starts;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const LaneT& lane = town.lanes[i];
        if (lane.kind != LaneKind::crossing)
            continue;
        CrossingPlace crossing;
        crossing.lane = i;
        crossing.from = to_eigen(lane.centre.front());
        crossing.to = to_eigen(lane.centre.back());
        crossing.lit = lit[i] != 0;
        const Eigen::Vector3d middle = (crossing.from + crossing.to) / 2;
        for (const std::uint32_t near : lanes.near(middle, lane.length / 2 + crossing_reach)) {
            const LaneT& road = town.lanes[near];
            if (road.kind != LaneKind::driving)
                continue;
            const auto note = [&](std::map<std::uint32_t, OnWay>& on_way, auto distance) {
                OnWay& least = on_way[near];
                if (distance && *distance < least.distance)
                    least = {*distance, crossings.size()};
            };
            if (road.junction == lane.junction)
                note(ends, reach(end_of(road), 1, crossing.from, crossing.to));
            note(starts, reach(point_at(road, 0), -1, crossing.from, crossing.to));
        }
        crossings.push_back(std::move(crossing));
    }
    for (const auto& [lane, on_way] : ends)
        if (on_way.distance <= crossing_reach)
            crossings[on_way.crossing].incoming.push_back(lane);
    for (const auto& [lane, on_way] : starts)
        if (on_way.distance <= crossing_reach)
            crossings[on_way.crossing].outgoing.push_back(lane);
    return crossings;
}

}  // namespace reprise::world
