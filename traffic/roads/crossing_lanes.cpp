#include "traffic/roads/crossing_lanes.h"

#include <algorithm>
#include <cstdint>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

constexpr double bodies = 1.9;  // [m] between middles: cars have no room beside each other
constexpr double joints = 4;    // [m] from a lane's ends: there the next one begins, or forks off

/// From one point of a centre line to the next one.
struct Piece {
    std::uint32_t lane;
    Eigen::Vector3d from;
    Eigen::Vector3d to;

    world::Box area() const {
        world::Box box;
        box.take(from.head<2>(), bodies);
        box.take(to.head<2>(), bodies);
        return box;
    }
};

std::vector<Piece> pieces_outside_junctions(const world::TownT& town) {
    std::vector<Piece> pieces;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        if (lane.kind == world::LaneKind::internal || !world::is_for_cars(lane))
            continue;
        if (lane.length <= 2 * joints)
            continue;
        Eigen::Vector3d from = world::point_at(lane, joints).position;
        double s = 0;
        for (std::size_t k = 0; k + 1 < lane.centre.size(); ++k) {
            const Eigen::Vector3d next = world::to_eigen(lane.centre[k + 1]);
            s += (next - world::to_eigen(lane.centre[k])).norm();
            if (s <= joints)
                continue;
            if (s >= lane.length - joints)
                break;
            pieces.push_back({i, from, next});
            from = next;
        }
        pieces.push_back({i, from, world::point_at(lane, lane.length - joints).position});
    }
    return pieces;
}

bool are_in_each_others_way(const Piece& one, const Piece& other) {
    const auto [low, high] = std::minmax({one.from.z(), one.to.z()});
    const auto [its_low, its_high] = std::minmax({other.from.z(), other.to.z()});
    return low < its_high + world::level_clearance && its_low < high + world::level_clearance &&
           world::distance_to({one.from.head<2>(), one.to.head<2>()},
                              other.from.head<2>(),
                              other.to.head<2>()) < bodies;
}

}  // namespace

std::vector<bool> lanes_that_cross(const world::TownT& town) {
    const std::vector<Piece> pieces = pieces_outside_junctions(town);
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        entries.push_back({pieces[i].area(), i});
    const world::BoxGrid by_place(entries);
    std::vector<bool> cross(town.lanes.size(), false);
    for (const Piece& one : pieces) {
        if (cross[one.lane])
            continue;
        const auto near = by_place.near(one.area());
        cross[one.lane] = std::any_of(near.begin(), near.end(), [&](std::uint32_t i) {
            return town.lanes[pieces[i].lane].edge != town.lanes[one.lane].edge &&
                   are_in_each_others_way(one, pieces[i]);
        });
    }
    return cross;
}

}  // namespace reprise::traffic
