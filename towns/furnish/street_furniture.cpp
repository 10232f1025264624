#include "towns/furnish/street_furniture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "towns/check/furniture_check.h"
#include "towns/furnish/draws.h"
#include "towns/furnish/props.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::PropKind;
using world::Purpose;

constexpr double light_spacing = 60;  ///< [m] on one side of a street
constexpr double light_height = 7.5;
constexpr double pole_width = 0.16;
constexpr double pole_spacing = 38;  ///< [m] of telephone lines
constexpr double stop_spacing = 400;
constexpr double shortest_for_stop = 90;
constexpr double at_kerb = 0.45;     ///< [m] of a bollard's middle from the kerb
constexpr double off_border = 0.05;  ///< [m] inside of a sidewalk's outer edge

double yaw_of(const Vector2d& way) {
    return std::atan2(way.y(), way.x());
}

/// On the sidewalk along its outer edge, where walkers can still pass by; not where another
/// sidewalk lies behind that edge.
std::optional<PropCandidate> on_walk(const PlacementContext& context,
                                     const Roadside& roadside,
                                     double s,
                                     PropKind kind,
                                     double length,
                                     double width,
                                     double height) {
    if (roadside.walk - width - off_border < walking_width ||
        !context.walks.is_clear(roadside_pose(roadside, s, 0.4).position, 0.1))
        return std::nullopt;
    const RoadsidePose at = roadside_pose(roadside, s, -off_border - width / 2);
    PropCandidate candidate;
    candidate.kind = kind;
    // Who sits or waits there looks at the road: it is on the side of its y.
    candidate.footprint = {at.position, facing_yaw(roadside, at) + std::numbers::pi, length, width};
    candidate.height = height;
    candidate.road_z = at.z;
    candidate.from_solid = walking_width;
    return candidate;
}

/// How far inside of a road's border its poles stand in line: on narrow sidewalks at their very
/// edge, beside roads without one behind it. [m]
double pole_line(const Roadside& roadside) {
    const double off_way = roadside.walk / 2 - walkway_half_width - towns::pole_radius - off_border;
    return roadside.walk > 0 ? std::min(roadside.walk / 6, off_way) : -0.9;
}

/// Poles stand closer to other things than what walkers must walk around: in line with them.
PropCandidate light(const Roadside& roadside, double s) {
    const double inside = pole_line(roadside);
    const RoadsidePose at = roadside_pose(roadside, s, -inside);
    const double to_road = roadside.walk - inside;
    PropCandidate candidate;
    candidate.kind = PropKind::street_light;
    candidate.height = light_height;
    candidate.footprint = {
        at.position, yaw_of(-at.out), std::clamp(to_road + 0.8, 1.2, 3.2), pole_width};
    candidate.road_z = at.z;
    candidate.from_solid = roadside.walk > 0 ? walking_width : 0.5;
    return candidate;
}

/// Of a street's two directions, the one whose lights begin a half turn later.
bool is_second(const PlacementContext& context, const Roadside& roadside) {
    std::uint32_t lane = roadside.driven;
    const bool to_left = !context.town.left_hand;
    for (;;) {
        const world::LaneT& here = context.town.lanes[lane];
        const std::uint32_t next = to_left ? here.left : here.right;
        if (next == world::none)
            return here.opposite != world::none && here.opposite < lane;
        lane = next;
    }
}

bool has_road(const Roadside& roadside) {
    return roadside.kerb_side && roadside.driven != world::none;
}

void add_small(PlacementContext& context, const Roadside& roadside, Draws& draws) {
    struct Kind {
        PropKind kind;
        double share, length, width, height;
    };

    static constexpr Kind kinds[] = {{PropKind::bench, 0.34, 1.8, 0.55, 0.85},
                                     {PropKind::bin, 0.62, 0.45, 0.45, 0.9},
                                     {PropKind::mailbox, 0.72, 0.45, 0.4, 1.2},
                                     {PropKind::hydrant, 0.84, 0.35, 0.35, 0.8},
                                     {PropKind::bollard, 1.0, 0.2, 0.2, 0.9}};
    for (double s = draws.between(6, 25); s < roadside.border.length - 4;
         s += draws.between(14, 34)) {
        const double drawn = draws.between(0, 1);
        const Kind* kind = std::find_if(
            std::begin(kinds), std::end(kinds), [&](const Kind& k) { return drawn < k.share; });
        const std::uint32_t style = draws.style();
        for (int i = 0; i < (kind->kind == PropKind::bollard ? 4 : 1); ++i) {
            auto candidate = on_walk(context,
                                     roadside,
                                     s + 1.6 * i,
                                     kind->kind,
                                     kind->length,
                                     kind->width,
                                     kind->height);
            if (!candidate)
                continue;
            // Bollards keep cars off: they stand at the kerb.
            if (kind->kind == PropKind::bollard)
                candidate->footprint.centre =
                    roadside_pose(roadside, s + 1.6 * i, at_kerb - roadside.walk).position;
            candidate->style = style;
            place_prop(context, *candidate);
        }
    }
}

/// Wooden poles, as telephone lines have them: along half of the roads without sidewalks, behind
/// their border, and along some streets, in line with the lights.
void add_poles(PlacementContext& context, const Roadside& roadside, Draws& draws) {
    const bool street = roadside.walk > 0;
    if (!draws.chance(street ? 0.2 : 0.5))
        return;
    for (double s = draws.between(5, 30); s < roadside.border.length - (street ? 4 : 0);
         s += pole_spacing) {
        const RoadsidePose at = roadside_pose(roadside, s, street ? -pole_line(roadside) : 2.2);
        PropCandidate candidate;
        candidate.kind = PropKind::pole;
        candidate.footprint = {at.position, at.yaw, 0.24, 0.24};
        candidate.height = 7;
        candidate.road_z = at.z;
        candidate.from_solid = street ? walking_width : 0.6;
        candidate.from_walk = street ? -1 : 0.2;
        candidate.style = draws.style();
        place_prop(context, candidate);
    }
}

/// A shelter on the sidewalk, some 40 % of the street behind its start or where there is room.
bool add_bus_stop(PlacementContext& context,
                  const Roadside& roadside,
                  double wanted,
                  std::uint32_t style) {
    const double width = std::min({1.3,
                                   roadside.walk - walking_width - off_border,
                                   roadside.walk / 2 - walkway_half_width - off_border});
    for (const double off : {0.0, 0.08, -0.08, 0.16, -0.16}) {
        const double s = (wanted + off) * roadside.border.length;
        auto candidate = on_walk(context, roadside, s, PropKind::bus_stop, 4, width, 2.5);
        if (!candidate)
            continue;
        candidate->style = style;
        if (place_prop(context, *candidate))
            return true;
    }
    return false;
}

}  // namespace

void place_street_lights(PlacementContext& context) {
    for (const Roadside& roadside : context.roadsides) {
        if (!has_road(roadside))
            continue;
        const double length = roadside.border.length;
        const bool second = is_second(context, roadside);
        for (double s = 15; s < length - 4; s += light_spacing) {
            const double from_start = second ? length - s - light_spacing / 2 : s;
            if (from_start > 2)
                place_prop(context, light(roadside, from_start));
        }
        if (context.town.lanes[roadside.driven].opposite == world::none)
            for (double s = 15 + light_spacing / 2; s < length - 4; s += light_spacing)
                place_prop(context, light(roadside, s));
    }
}

void place_bus_stops(PlacementContext& context) {
    std::vector<Vector2d> stops;
    for (std::uint32_t i = 0; i < context.roadsides.size(); ++i) {
        const Roadside& roadside = context.roadsides[i];
        const double length = roadside.border.length;
        if (!has_road(roadside) || roadside.walk < 2 || length < shortest_for_stop)
            continue;
        Draws draws(context.seed, Purpose::furniture, 4ULL << 32 | i);
        const double wanted = draws.between(0.3, 0.6);
        const Vector2d here = roadside_pose(roadside, wanted * length, 0).position;
        // The stop of the other direction is across the street; the next pair is far.
        const bool too_near = std::any_of(stops.begin(), stops.end(), [&](const Vector2d& stop) {
            const double apart = (stop - here).norm();
            return apart > 60 && apart < 0.8 * stop_spacing;
        });
        const bool beside = std::any_of(stops.begin(), stops.end(), [&](const Vector2d& stop) {
            return (stop - here).norm() <= 20;
        });
        if (too_near || beside)
            continue;
        if (add_bus_stop(context, roadside, wanted, draws.style()))
            stops.push_back(world::in_plan(context.town.props.back().position()));
    }
}

void place_small_furniture(PlacementContext& context) {
    for (std::uint32_t i = 0; i < context.roadsides.size(); ++i) {
        const Roadside& roadside = context.roadsides[i];
        if (!has_road(roadside))
            continue;
        Draws draws(context.seed, Purpose::furniture, i);
        if (roadside.walk > 0) {
            Draws poles(context.seed, Purpose::furniture, 5ULL << 32 | i);
            add_poles(context, roadside, poles);
            add_small(context, roadside, draws);
        } else {
            add_poles(context, roadside, draws);
        }
    }
}

}  // namespace reprise::towns
