#include "towns/check/ends_check.h"

#include <algorithm>
#include <string>

#include "ground/mesh/ground_probe.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

constexpr double drop_limit = 1.0;   ///< [m]
constexpr double beyond_end = 2.0;   ///< [m]
constexpr double probe_above = 1.0;  ///< [m] plumb lines start
constexpr double no_terrain = 10;    ///< [m] said of an end beyond the terrain
constexpr double turning = 12;       ///< [m] a place to turn round reaches beyond its lanes at most

/// From a street's end to the ground that lies `beyond_end` of the last of its road, at worst.
double drop_at(const ground::GroundProbe& probe,
               const Eigen::Vector3d& end,
               const Eigen::Vector2d& outward) {
    const auto ground_at = [&](double away) {
        const Eigen::Vector2d p = end.head<2>() + away * outward;
        return probe.below({p.x(), p.y(), end.z() + probe_above});
    };
    const auto is_road = [&](double away) {
        const auto hit = ground_at(away);
        return hit && hit->surface == ground::Surface::road && end.z() - hit->z < drop_limit;
    };
    constexpr double step = beyond_end / 4;
    double edge = 0;
    while (edge < turning && is_road(edge + step))
        edge += step;
    double deepest = 0;
    for (const double away : {beyond_end / 4, beyond_end / 2, beyond_end}) {
        const auto hit = ground_at(edge + away);
        deepest = std::max(deepest, hit ? end.z() - hit->z : no_terrain);
    }
    return deepest;
}

/// Does it only lead back, to where one came from?
bool is_way_back(const world::Link& link) {
    return link.turn() == world::Turn::around;
}

}  // namespace

Criterion check_ends(const world::TownT& town, const ground::GroundMesh& ground) {
    const ground::GroundProbe probe(ground);
    std::vector<bool> is_reached(town.lanes.size(), false);
    for (const world::LaneT& lane : town.lanes)
        for (const world::Link& link : lane.links)
            if (link.to() < is_reached.size() && !is_way_back(link))
                is_reached[link.to()] = true;
    Measured drops("floating ends", drop_limit, "m");
    for (std::size_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        if (lane.kind != world::LaneKind::driving)
            continue;
        const auto take = [&](double s, double sign) {
            const world::LanePoint at = world::point_at(lane, s);
            drops.take(lane.name,
                       at.position.head<2>(),
                       drop_at(probe, at.position, sign * world::ahead_of(at.yaw)));
        };
        if (std::all_of(lane.links.begin(), lane.links.end(), is_way_back))
            take(lane.length, 1);
        if (!is_reached[i])
            take(0, -1);
    }
    const std::string looked_at = std::to_string(drops.count()) + " ends of streets";
    return std::move(drops).verdict(looked_at);
}

}  // namespace reprise::towns
