#include "tests/walkers/map/seams.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "ground/mesh/ground.h"
#include "world/geometry2d.h"

namespace reprise::test {

namespace {

using walkers::WalkMap;
using world::LaneKind;

constexpr double kerb = ground::kerb_height;

bool is_for_walkers(const world::LaneT& lane) {
    return lane.kind == LaneKind::sidewalk || lane.kind == LaneKind::crossing ||
           lane.kind == LaneKind::walking_area;
}

/// Of a walking area the middle of its outline, of a crossing that of its line, of a sidewalk some
/// metres from where the two meet.
Eigen::Vector3d middle_of(const world::LaneT& lane, const Eigen::Vector3d& meeting) {
    if (!lane.outline.empty()) {
        Eigen::Vector3d sum(0, 0, 0);
        for (const world::Vec3& corner : lane.outline)
            sum += Eigen::Vector3d(corner.x(), corner.y(), corner.z());
        return sum / static_cast<double>(lane.outline.size()) + Eigen::Vector3d(0, 0, kerb);
    }
    constexpr double along = 4;  // [m]
    if (lane.kind == LaneKind::crossing)
        return world::point_at(lane, lane.length / 2).position;
    const double s = world::project(lane, meeting).s;
    const double inside = s < lane.length / 2 ? std::min(s + along, lane.length / 2)
                                              : std::max(s - along, lane.length / 2);
    return world::point_at(lane, inside).position + Eigen::Vector3d(0, 0, kerb);
}

/// Where somebody is who went along a way in steps of a walker's tick; none: at its end.
std::optional<Eigen::Vector3d> stuck_on(const WalkMap& map,
                                        WalkMap::Place place,
                                        const std::vector<WalkMap::Step>& way) {
    constexpr double step = 0.07;  // [m]
    constexpr double there = 0.4;  // [m]
    constexpr double at_corner = 0.05;
    constexpr int most_steps = 5000;
    std::size_t corner = 1;
    int idle = 0;
    for (int i = 0; i < most_steps && corner < way.size(); ++i) {
        const Eigen::Vector2d gap = (way[corner].position - place.position).head<2>();
        if (gap.norm() < there && (gap.norm() < at_corner || corner + 1 == way.size() ||
                                   map.is_clear(place, way[corner + 1].position))) {
            ++corner;
            continue;
        }
        const Eigen::Vector2d by = std::min(step, gap.norm()) * gap.normalized();
        const WalkMap::Place next =
            map.slide(place, place.position + Eigen::Vector3d(by.x(), by.y(), 0));
        idle = (next.position - place.position).head<2>().norm() < step / 10 ? idle + 1 : 0;
        place = next;
        if (idle > 20)
            return place.position;
    }
    return corner < way.size() ? std::optional(place.position) : std::nullopt;
}

double length_of(const std::vector<WalkMap::Step>& way) {
    double length = 0;
    for (std::size_t i = 1; i < way.size(); ++i)
        length += (way[i].position - way[i - 1].position).head<2>().norm();
    return length;
}

}  // namespace

Seams seams_of(const world::TownT& town, const WalkMap& map) {
    Seams seams;
    for (const world::LaneT& lane : town.lanes)
        for (const world::Link& link : lane.links) {
            if (link.to() == world::none || !is_for_walkers(lane) ||
                !is_for_walkers(town.lanes[link.to()]))
                continue;
            const world::LaneT& other = town.lanes[link.to()];
            const Eigen::Vector3d one = middle_of(lane, middle_of(other, {0, 0, 0}));
            const Eigen::Vector3d two = middle_of(other, one);
            const Eigen::Vector3d start = middle_of(lane, two);
            ++seams.pairs;
            const auto from = map.nearest(start);
            const auto to = map.nearest(two);
            if (!from || !to) {
                ++seams.off;
                continue;
            }
            const auto say = [&](const Eigen::Vector3d& where, std::string why) {
                seams.all.push_back({lane.name, other.name, where, std::move(why)});
            };
            const auto way = map.path(*from, *to);
            if (!way) {
                say(start, "no way");
                continue;
            }
            const double straight = (two - start).head<2>().norm();
            if (const double length = length_of(*way); length > 2 * straight + 10)
                say(start, fmt::format("{:.0f} m for {:.0f} m", length, straight));
            else if (const auto stuck = stuck_on(map, *from, *way))
                say(*stuck, "stuck");
        }
    return seams;
}

}  // namespace reprise::test
