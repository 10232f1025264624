// What it must do: find the road whose end a sign is for.
// What it assumes: nodes lie on the line that the map drew, which is the middle of a road or of one
//   of its directions; "-X" is the edge against its way.
// How it goes: roads are lengthened straight on to the middle of their junction, because netconvert
//   cuts them there; of those that pass over the node, the one with the nearest junction is taken.
// What it keeps: the order of the map.
#include "towns/import/map_signs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;

constexpr double farthest = 50;  ///< [m] from the junction
constexpr double beside = 2;     ///< [m] outside of the lane
constexpr double middle = 3;     ///< [m] a node this near to a junction's centre is in the junction

/// Distance along the lane from a node to the middle of the junction at the lane's end; nothing
/// when the node is not on the lane, or beyond the junction. [m]
std::optional<double> distance_to_junction(const world::LaneT& lane,
                                           const Vector2d& node,
                                           const Vector2d& junction) {
    const Vector2d end = world::in_plan(lane.centre.back());
    const double yaw = world::point_at(lane, lane.length).yaw;
    const Vector2d ahead(std::cos(yaw), std::sin(yaw));
    const double past_end = ahead.dot(node - end);
    const double end_to_junction = std::max(0.0, ahead.dot(junction - end));
    const double reach = lane.width / 2 + beside;
    if (past_end > 0)
        return past_end < end_to_junction && std::abs(world::cross(ahead, node - end)) < reach
                   ? std::optional(end_to_junction - past_end)
                   : std::nullopt;
    const world::LaneProjection on = world::project(lane, {node.x(), node.y(), 0});
    if (on.distance > reach || on.s <= 0)
        return std::nullopt;
    return lane.length - on.s + end_to_junction;
}

bool is_on_side(const world::LaneT& lane, const std::string& direction) {
    const bool against = lane.edge.starts_with('-');
    return direction == "forward" ? !against : direction == "backward" ? against : true;
}

bool has_junction(const world::TownT& town, const world::LaneT& lane) {
    return lane.kind == world::LaneKind::driving && lane.junction != world::none &&
           !lane.links.empty() && town.junctions.size() > lane.junction;
}

Vector2d centre(const world::TownT& town, const world::LaneT& lane) {
    return world::in_plan(town.junctions[lane.junction].centre);
}

std::optional<std::uint32_t> lane_of(const MapShape& sign, const world::TownT& town) {
    const Vector2d node = world::in_plan(sign.line.front());
    const std::string direction = tag_value(sign.tags, "direction");
    std::optional<std::uint32_t> found;
    double nearest = farthest;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        if (!has_junction(town, lane) || !is_on_side(lane, direction))
            continue;
        const auto distance = distance_to_junction(lane, node, centre(town, lane));
        if (!distance || *distance >= nearest)
            continue;
        nearest = *distance;
        found = i;
    }
    return found;
}

}  // namespace

std::vector<LaneSign> lane_signs(const std::vector<MapShape>& signs, const world::TownT& town) {
    std::vector<LaneSign> found;
    for (const MapShape& sign : signs) {
        const Vector2d node = world::in_plan(sign.line.front());
        const bool stops = tag_value(sign.tags, "highway") == "stop";
        bool in_junction = false;
        for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
            const world::LaneT& lane = town.lanes[i];
            if (!has_junction(town, lane) || (centre(town, lane) - node).norm() > middle)
                continue;
            in_junction = true;
            if (stops && tag_value(sign.tags, "stop") == "all")
                found.push_back({i, true});
        }
        if (in_junction)
            continue;
        if (const auto lane = lane_of(sign, town))
            found.push_back({*lane, stops});
    }
    return found;
}

}  // namespace reprise::towns
