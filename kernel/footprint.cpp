#include "kernel/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "ground/mesh/polygons.h"
#include "ground/mesh/ribbon.h"
#include "world/geometry2d.h"

namespace reprise::kernel {

namespace {

constexpr double level = 3;  ///< [m] as LaneMap: what is higher or lower is another road

/// What lies under one point of a vehicle that heads `ahead`.
struct Under {
    bool opposite_lane = false;
    bool sidewalk = false;
};

/// `near`: the lanes around.
Under look_under(const world::TownT& town,
                 const world::LaneMap& lanes,
                 std::span<const std::uint32_t> near,
                 const Eigen::Vector3d& p_world,
                 const Eigen::Vector3d& ahead) {
    bool with = false;
    bool against = false;
    const auto found = lanes.at(p_world, near);
    for (const auto& [lane, at] : found) {
        const double yaw = world::point_at(town.lanes[lane], at.s).yaw;
        const bool same = ahead.x() * std::cos(yaw) + ahead.y() * std::sin(yaw) > 0;
        with = with || same;
        against = against || !same;
    }
    return {against && !with, found.empty() && !lanes.walkable_at(p_world, near).empty()};
}

/// The surfaces around a footprint, by what they are to it.
struct Surfaces {
    explicit Surfaces(const Eigen::Vector2d& origin)
        : with(origin),
          against(origin),
          walkable(origin) {}

    ground::Area with;
    ground::Area against;
    ground::Area walkable;
};

/// A lane's surface, segment by segment: each runs its own way.
void add_ribbon(const world::LaneT& lane,
                const Eigen::Isometry3d& pose_world_vehicle,
                double reach,
                Surfaces& surfaces) {
    const bool is_way = world::is_for_cars(lane);
    const Eigen::Vector3d here = pose_world_vehicle.translation();
    const Eigen::Vector3d ahead = pose_world_vehicle.linear().col(0);
    const auto line = ground::clean_line(lane.centre);
    const ground::Ribbon ribbon = ground::make_ribbon(line, -lane.width / 2, lane.width / 2);
    for (const auto& piece : ribbon.pieces) {
        const world::Loop loop = world::in_plan(piece);
        const world::Box box = world::box_around(loop, reach);
        const double z = piece.front().z();
        if ((here.head<2>().array() < box.low.array()).any() ||
            (here.head<2>().array() > box.high.array()).any() || std::abs(z - here.z()) > level)
            continue;
        // From its right border's first corner to the second: the way that it runs.
        const Eigen::Vector3d along = piece[1] - piece[0];
        ground::Area& area = !is_way                                    ? surfaces.walkable
                             : along.head<2>().dot(ahead.head<2>()) > 0 ? surfaces.with
                                                                        : surfaces.against;
        area.add(loop);
    }
}

Surfaces surfaces_around(const world::TownT& town,
                         std::span<const std::uint32_t> near,
                         const Eigen::Isometry3d& pose_world_vehicle,
                         double reach) {
    Surfaces surfaces(pose_world_vehicle.translation().head<2>());
    for (const std::uint32_t index : near) {
        const world::LaneT& lane = town.lanes[index];
        if (lane.outline.empty())
            add_ribbon(lane, pose_world_vehicle, reach, surfaces);
        else if (std::any_of(lane.outline.begin(), lane.outline.end(), [&](const world::Vec3& p) {
                     return std::abs(p.z() - pose_world_vehicle.translation().z()) <= level;
                 }))
            surfaces.walkable.add(world::in_plan(lane.outline));
    }
    return surfaces;
}

}  // namespace

FootprintShares footprint_shares(const world::TownT& town,
                                 const world::LaneMap& lanes,
                                 const world::VehicleModel& model,
                                 const Eigen::Isometry3d& pose_world_vehicle) {
    const Eigen::Vector3d ahead = pose_world_vehicle.linear().col(0);
    const double rear = -model.rear_overhang;
    const double front = model.length - model.rear_overhang;
    const Eigen::Vector3d middle((rear + front) / 2, 0, 0);
    const double reach = std::hypot(model.length, model.width) / 2;
    const std::vector<std::uint32_t> near = lanes.near(pose_world_vehicle * middle, reach);
    const std::array<Eigen::Vector3d, 5> probes{
        pose_world_vehicle * Eigen::Vector3d(rear, -model.width / 2, 0),
        pose_world_vehicle * Eigen::Vector3d(front, -model.width / 2, 0),
        pose_world_vehicle * Eigen::Vector3d(front, model.width / 2, 0),
        pose_world_vehicle * Eigen::Vector3d(rear, model.width / 2, 0),
        pose_world_vehicle * middle};
    if (std::none_of(probes.begin(), probes.end(), [&](const Eigen::Vector3d& p) {
            const Under under = look_under(town, lanes, near, p, ahead);
            return under.opposite_lane || under.sidewalk;
        }))
        return {};
    ground::Area footprint(pose_world_vehicle.translation().head<2>());
    world::Loop outline;
    for (std::size_t i = 0; i < 4; ++i)
        outline.emplace_back(probes[i].head<2>());
    footprint.add(outline);
    const double whole = footprint.size();
    Surfaces surfaces = surfaces_around(town, near, pose_world_vehicle, 2 * reach);
    ground::Area opposite = footprint.copy();
    opposite.intersect(surfaces.against);
    opposite.subtract(surfaces.with);
    ground::Area sidewalk = footprint.copy();
    sidewalk.intersect(surfaces.walkable);
    sidewalk.subtract(surfaces.with);
    sidewalk.subtract(surfaces.against);
    return whole > 0 ? FootprintShares{opposite.size() / whole, sidewalk.size() / whole}
                     : FootprintShares{};
}

}  // namespace reprise::kernel
