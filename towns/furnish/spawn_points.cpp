#include "towns/furnish/spawn_points.h"

#include <array>
#include <cmath>

#include "ground/mesh/ground.h"
#include "world/lane_starts.h"
#include "world/town_generated.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::LaneKind;
using world::LaneT;

constexpr double vehicle_spacing = 25;
constexpr double after_junction = 12;
constexpr double before_end = 15;
constexpr double walker_spacing = 20;
constexpr double walker_end = 3;       ///< [m] before the ends of a sidewalk
constexpr double longest_start = 5.5;  ///< [m] what starts there without asking
constexpr double car_width = 2.1;

void add_spawn_point(PlacementContext& context,
                     std::uint32_t lane,
                     double s,
                     const world::LanePoint& at,
                     const Vector2d& p,
                     double raised) {
    context.town.spawn_points.emplace_back(world::Vec3(p.x(), p.y(), at.position.z() + raised),
                                           at.yaw,
                                           s,
                                           lane,
                                           raised > 0,
                                           std::uint8_t{0},
                                           std::uint16_t{0});
}

void add_on_driving_lane(PlacementContext& context, std::uint32_t index) {
    const LaneT& lane = context.town.lanes[index];
    const world::LaneStarts starts(lane);
    for (double s = after_junction; s <= lane.length - before_end; s += vehicle_spacing) {
        const world::LanePoint at = starts.at(lane, s);
        if (context.solid.is_clear({at.position.head<2>(), at.yaw, longest_start, car_width}, 0.3))
            add_spawn_point(context, index, s, at, at.position.head<2>(), 0);
    }
}

void add_on_sidewalk(PlacementContext& context, std::uint32_t index) {
    const LaneT& lane = context.town.lanes[index];
    const world::LaneStarts starts(lane);
    for (double s = walker_end; s <= lane.length - walker_end; s += walker_spacing) {
        const world::LanePoint at = starts.at(lane, s);
        const Vector2d left = world::left_of(at.yaw);
        // Beside what stands in the middle.
        for (const double t : std::array{0.0, 0.4, -0.4, 0.8, -0.8}) {
            const Vector2d p = at.position.head<2>() + left * t;
            if (std::abs(t) > lane.width / 2 - 0.3 || !context.solid.is_clear(p, 0.4) ||
                !context.roads.is_clear(p, 0.2))
                continue;
            add_spawn_point(context, index, s, at, p, ground::kerb_height);
            break;
        }
    }
}

}  // namespace

void place_spawn_points(PlacementContext& context) {
    for (const LaneKind kind : {LaneKind::driving, LaneKind::sidewalk})
        for (std::uint32_t i = 0; i < context.town.lanes.size(); ++i) {
            if (context.town.lanes[i].kind != kind)
                continue;
            if (kind == LaneKind::driving)
                add_on_driving_lane(context, i);
            else
                add_on_sidewalk(context, i);
        }
}

}  // namespace reprise::towns
