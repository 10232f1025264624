#include "towns/furnish/roadside.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "towns/network/lanes.h"
#include "world/geometry2d.h"

namespace reprise::towns {

namespace {

using world::LaneKind;
using world::LaneT;
using world::TownT;

bool is_of_a_road(const LaneT& lane) {
    return !lane.edge.empty() && lane.edge.front() != ':' && lane.kind != LaneKind::internal &&
           lane.kind != LaneKind::crossing && lane.kind != LaneKind::walking_area;
}

LaneT border_of(const LaneT& lane, double side) {
    LaneT border;
    border.centre = offset_line(lane.centre, side * lane.width / 2);
    for (std::size_t i = 1; i < border.centre.size(); ++i) {
        const world::Vec3& p = border.centre[i - 1];
        const world::Vec3& q = border.centre[i];
        border.length += std::hypot(q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
    }
    return border;
}

/// The driving lane with the lowest index, for each road that has one.
std::map<std::string, std::uint32_t> outermost_driven(const TownT& town) {
    std::map<std::string, std::uint32_t> found;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const LaneT& lane = town.lanes[i];
        if (lane.kind != LaneKind::driving)
            continue;
        const auto [place, is_new] = found.emplace(lane.edge, i);
        if (!is_new && lane.index < town.lanes[place->second].index)
            place->second = i;
    }
    return found;
}

}  // namespace

std::vector<Roadside> roadsides(const TownT& town) {
    const double kerb_side = town.left_hand ? 1 : -1;
    const auto driven = outermost_driven(town);
    std::vector<Roadside> found;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const LaneT& lane = town.lanes[i];
        if (!is_of_a_road(lane))
            continue;
        const auto road = driven.find(lane.edge);
        const std::uint32_t nearest = road == driven.end() ? world::none : road->second;
        if (lane.index == 0)
            found.push_back({i,
                             nearest,
                             true,
                             kerb_side,
                             lane.kind == LaneKind::sidewalk ? lane.width : 0,
                             border_of(lane, kerb_side)});
        const bool innermost = (town.left_hand ? lane.right : lane.left) == world::none;
        if (lane.kind == LaneKind::driving && innermost && lane.opposite == world::none)
            found.push_back({i, i, false, -kerb_side, 0, border_of(lane, -kerb_side)});
    }
    return found;
}

RoadsidePose roadside_pose(const Roadside& roadside, double s, double away) {
    const world::LanePoint at = roadside.starts.at(roadside.border, s);
    const Eigen::Vector2d left = world::left_of(at.yaw);
    const Eigen::Vector2d out = left * roadside.side;
    return {at.position.head<2>() + out * away, at.position.z(), at.yaw, out};
}

double facing_yaw(const Roadside& roadside, const RoadsidePose& at) {
    return roadside.side > 0 ? at.yaw : at.yaw + std::numbers::pi;
}

}  // namespace reprise::towns
