#include "drivers/road_view.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace reprise::drivers {

namespace {

constexpr double widest_view = 20;  // [m] beside the path

bool is_driving(const world::TownT& town, std::uint32_t lane) {
    return lane < town.lanes.size() && town.lanes[lane].kind == world::LaneKind::driving;
}

/// Width of the lanes beside this one, the neighbours on that side. [m]
double lanes_beside(const world::TownT& town,
                    std::uint32_t lane,
                    std::uint32_t world::LaneT::*side) {
    double width = 0;
    for (std::uint32_t next = town.lanes[lane].*side; is_driving(town, next);
         next = town.lanes[next].*side)
        width += town.lanes[next].width;
    return width;
}

/// Across the centre line, which lies on this side of the lane and its neighbours. [m]
double oncoming_beside(const world::TownT& town,
                       std::uint32_t lane,
                       std::uint32_t world::LaneT::*side) {
    std::uint32_t last = lane;
    while (is_driving(town, town.lanes[last].*side))
        last = town.lanes[last].*side;
    const std::uint32_t opposite = town.lanes[last].opposite;
    if (!is_driving(town, opposite))
        return 0;
    // From there away from us: to what they call the other side.
    const auto away = side == &world::LaneT::left ? &world::LaneT::right : &world::LaneT::left;
    return town.lanes[opposite].width + lanes_beside(town, opposite, away);
}

/// Where a point lies along and beside a path that goes on straight at both ends.
struct Place {
    double s = 0;
    double left = 0;
    Eigen::Vector2d direction;
    double z = 0;
};

Place place_on(const Path& path, const Eigen::Vector2d& p, double from, double to) {
    const double s = path.project({p.x(), p.y(), 0}, from, std::max(to - from, 0.0));
    const PathPoint here = path.at(s);
    const Eigen::Vector2d offset = p - here.position.head<2>();
    const double beyond = offset.dot(here.direction);
    const bool at_end = s <= path.start() + Path::spacing || s >= path.end() - Path::spacing;
    return {at_end ? s + beyond : s,
            world::cross(here.direction, offset),
            here.direction,
            here.position.z()};
}

}  // namespace

RoadWidth road_width(const world::TownT& town, std::uint32_t lane) {
    const double half = town.lanes[lane].width / 2;
    RoadWidth road{half, half, half, half, half, half};
    if (town.lanes[lane].kind != world::LaneKind::driving)
        return road;
    const auto left = &world::LaneT::left;
    const auto right = &world::LaneT::right;
    road.own_left += lanes_beside(town, lane, left);
    road.own_right += lanes_beside(town, lane, right);
    road.road_left = road.own_left + (town.left_hand ? 0 : oncoming_beside(town, lane, left));
    road.road_right = road.own_right + (town.left_hand ? oncoming_beside(town, lane, right) : 0);
    return road;
}

void look_along(const world::TickView& last,
                const Ego& ego,
                const Path& path,
                double behind,
                double ahead,
                std::vector<Neighbour>& neighbours) {
    neighbours.clear();
    const double from = std::max(ego.rear_axle_s - behind, path.start());
    const double to = std::min(ego.rear_axle_s + ahead, path.end());
    world::Box box;
    for (std::size_t i = path.index(from); i < path.index(to); i += 8)
        box.take(path.points()[i].position.head<2>(), widest_view);
    box.take(path.at(to).position.head<2>(), widest_view);
    box.take(ego.position.head<2>() - behind * ego.direction, widest_view);
    std::vector<Body> bodies;
    collect_bodies(last, ego.id, box, 0, bodies);
    for (const Body& body : bodies) {
        const Place at = place_on(path, body.centre, from, to);
        if (std::abs(at.left) > widest_view || std::abs(at.z - body.z) > world::level_clearance)
            continue;
        const double cosine = std::abs(at.direction.dot(body.direction));
        const double sine = std::abs(world::cross(at.direction, body.direction));
        const double half_length = cosine * body.half_length + sine * body.half_width;
        const double half_width = sine * body.half_length + cosine * body.half_width;
        neighbours.push_back({body,
                              at.s - half_length,
                              at.s + half_length,
                              at.left - half_width,
                              at.left + half_width,
                              body.velocity.dot(at.direction)});
    }
}

double distance_along_lanes(const LaneGraph& graph,
                            std::uint32_t lane,
                            double s,
                            std::uint32_t goal,
                            double goal_s,
                            double most) {
    const std::vector<world::LaneT>& lanes = graph.town().lanes;
    if (lane >= lanes.size() || most < 0)
        return world::infinity;
    if (lane == goal)
        return s <= goal_s ? goal_s - s : world::infinity;
    // Nearest first, each lane once: where lanes are short there are more ways than one can try.
    std::set<std::pair<double, std::uint32_t>> open{{0.0, lane}};
    std::set<std::uint32_t> reached;
    const auto reach = [&](std::uint32_t to, double distance) {
        if (to < lanes.size() && distance <= most)
            open.emplace(distance, to);
    };
    while (!open.empty()) {
        const auto [distance, at] = *open.begin();
        open.erase(open.begin());
        if (at == goal)
            return distance + goal_s;
        if (!reached.insert(at).second)
            continue;
        const world::LaneT& here = lanes[at];
        const double end = distance + std::max(here.length - (at == lane ? s : 0.0), 0.0);
        if (here.kind == world::LaneKind::internal) {
            // The rest of its way over the junction counts as this lane alone.
            reach(graph.exit(at), end);
            continue;
        }
        for (const world::Link& link : here.links) {
            double behind = end;
            for (const std::uint32_t internal : graph.inside(link))
                behind += lanes[internal].length;
            reach(link.to(), behind);
        }
    }
    return world::infinity;
}

}  // namespace reprise::drivers
