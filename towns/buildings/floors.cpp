#include "towns/buildings/floors.h"

#include <limits>

#include "ground/mesh/terrain.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;

constexpr double before_door = 0.3;  ///< [m]
constexpr double off_floor = 1.2;  ///< [m] of the ground under a building, below or above its floor
constexpr double front_rise = 1.0;  ///< [m] along the front: rows have doors at its ends as well
constexpr double shortest = 1.6;    ///< [m] side of a building that has room for a door

/// Where one stands before the door of the street side: of the sides nearest to a road the longest
/// one.
std::optional<Vector2d> door_of(const PlacementContext& context, const world::Loop& loop) {
    std::optional<Vector2d> best;
    double nearest = std::numeric_limits<double>::max();
    double longest = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector2d along = loop[(i + 1) % loop.size()] - loop[i];
        const double length = along.norm();
        if (length < shortest)
            continue;
        const Vector2d out = Vector2d(along.y(), -along.x()) / length;
        const Vector2d door = loop[i] + along / 2 + out * before_door;
        const double to_road = context.roads.of(door);
        if (to_road > nearest || (to_road == nearest && length <= longest))
            continue;
        best = door;
        nearest = to_road;
        longest = length;
    }
    return best;
}

}  // namespace

std::optional<double> floor_on(const GroundHeights& ground_heights,
                               const Footprint& footprint,
                               double road_z) {
    if (ground_heights.is_level())
        return road_z;
    const Vector2d back = world::left_of(footprint.yaw);
    const Vector2d door = footprint.centre - back * (footprint.width / 2 + before_door);
    const auto ground = ground_heights.at(door, road_z);
    if (!ground)
        return std::nullopt;
    const double floor = *ground + ground::terrain_depth;
    const auto under = ground_heights.under(footprint, *ground);
    const auto front = ground_heights.under({door, footprint.yaw, footprint.length, 0}, *ground);
    if (!under || !front || under->low < floor - off_floor || under->high > floor + off_floor ||
        front->rise() > front_rise)
        return std::nullopt;
    return floor;
}

void set_floor(const PlacementContext& context, world::DrawnBuildingT& drawn) {
    if (context.ground_heights.is_level())
        return;
    const world::Loop loop = world::in_plan(drawn.outline);
    const Vector2d door = door_of(context, loop).value_or(loop[0]);
    const auto ground = context.ground_heights.at(door, drawn.outline[0].z());
    if (!ground)
        return;
    for (world::Vec3& corner : drawn.outline)
        corner.mutate_z(*ground + ground::terrain_depth);
}

}  // namespace reprise::towns
