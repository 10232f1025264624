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

/// What a vehicle covers.
class Footprint {
  public:
    Footprint(const world::Loop& outline, const Eigen::Isometry3d& pose_world_vehicle)
        : corner_(outline[0]),
          along_((outline[1] - outline[0]).normalized()),
          box_(box_of(outline)),
          z_(pose_world_vehicle.translation().z()),
          ahead_(pose_world_vehicle.linear().col(0).head<2>()) {}

    /// Of what is near, most does not reach below it, and would only cost time.
    bool may_lie_on(const world::Loop& loop) const { return world::touch(box_of(loop), box_); }

    bool is_level_with(double z) const { return std::abs(z - z_) <= level; }

    bool runs_with(const Eigen::Vector2d& way) const { return way.dot(ahead_) > 0; }

  private:
    /// Seen in the direction of its right side.
    world::Box box_of(const world::Loop& loop) const {
        world::Box box;
        for (const Eigen::Vector2d& p : loop)
            box.take({along_.dot(p - corner_), world::cross(along_, p - corner_)});
        return box;
    }

    Eigen::Vector2d corner_;
    Eigen::Vector2d along_;
    world::Box box_;
    double z_;
    Eigen::Vector2d ahead_;
};

/// A lane's surface, segment by segment: each runs its own way.
void add_ribbon(const world::LaneT& lane, const Footprint& footprint, Surfaces& surfaces) {
    const bool is_way = world::is_for_cars(lane);
    const auto line = ground::clean_line(lane.centre);
    const ground::Ribbon ribbon = ground::make_ribbon(line, -lane.width / 2, lane.width / 2);
    for (const auto& piece : ribbon.pieces) {
        const world::Loop loop = world::in_plan(piece);
        if (!footprint.is_level_with(piece.front().z()) || !footprint.may_lie_on(loop))
            continue;
        // From its right border's first corner to the second: the way that it runs.
        ground::Area& area = !is_way                                  ? surfaces.walkable
                             : footprint.runs_with(loop[1] - loop[0]) ? surfaces.with
                                                                      : surfaces.against;
        area.add(loop);
    }
}

Surfaces surfaces_below(const Footprint& footprint,
                        const Eigen::Vector2d& origin,
                        const world::TownT& town,
                        std::span<const std::uint32_t> near) {
    Surfaces surfaces(origin);
    for (const std::uint32_t index : near) {
        const world::LaneT& lane = town.lanes[index];
        if (lane.outline.empty())
            add_ribbon(lane, footprint, surfaces);
        else if (std::any_of(lane.outline.begin(), lane.outline.end(), [&](const world::Vec3& p) {
                     return footprint.is_level_with(p.z());
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
    const Eigen::Vector2d origin = pose_world_vehicle.translation().head<2>();
    world::Loop outline;
    for (std::size_t i = 0; i < 4; ++i)
        outline.emplace_back(probes[i].head<2>());
    ground::Area left(origin);
    left.add(outline);
    const double whole = left.size();
    if (whole <= 0)
        return {};
    const Surfaces below =
        surfaces_below(Footprint(outline, pose_world_vehicle), origin, town, near);
    left.subtract(below.with);
    const double not_with = left.size();
    left.subtract(below.against);
    const double beside_ways = left.size();
    left.subtract(below.walkable);
    const auto share = [whole](double area) { return std::max(area, 0.0) / whole; };
    return {share(not_with - beside_ways), share(beside_ways - left.size())};
}

}  // namespace reprise::kernel
