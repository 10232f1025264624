#include "towns/furnish/placement_context.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ground/mesh/ground.h"
#include "ground/mesh/terrain.h"
#include "ground/swept_area.h"
#include "world/digest.h"
#include "world/lane_starts.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::LaneKind;
using world::LaneT;

constexpr double level_cell = 24;     ///< [m]
constexpr double level_apart = 4;     ///< [m] of height: a bridge, or a slope of 6 %
constexpr double country_speed = 19;  ///< [m/s]
constexpr double narrowest = 1.25;    ///< [m] beside a path that is kept clear for cars
constexpr double turning_half = 1.6;  ///< [m] beside a turning path: buses cut corners

std::pair<std::int32_t, std::int32_t> level_cell_of(const Vector2d& p) {
    return {static_cast<std::int32_t>(std::floor(p.x() / level_cell)),
            static_cast<std::int32_t>(std::floor(p.y() / level_cell))};
}

Vector2d kerb_point(const LaneT& lane, double s, double side) {
    const world::LanePoint at = world::point_at(lane, s);
    return at.position.head<2>() + world::left_of(at.yaw) * (side * lane.width / 2);
}

constexpr int directions = 16;

/// One of those around a place.
Vector2d direction(int k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

PlacementContext::PlacementContext(world::TownT& target,
                                   const Place& source,
                                   const std::vector<GiveWay>& signed_lanes)
    : town(target),
      place(source),
      right_of_way(signed_lanes),
      seed(world::digest128(target.name).low()),
      roadsides(towns::roadsides(target)),
      ground_heights(target) {
    add_lanes();
    add_swept_area();
    for (const world::JunctionT& junction : town.junctions)
        junctions.add_polygon(junction.outline);
    for (const auto& outline : place.keep_clear)
        reserved.add_polygon(outline);
    for (const world::PlotT& plot : place.plots)
        reserved.add_polygon(plot.outline);
    add_sights();
}

void PlacementContext::add_lanes() {
    for (const LaneT& lane : town.lanes) {
        if (lane.kind == LaneKind::crossing)
            crossings.add_polygon(lane.outline);
        else if (lane.kind == LaneKind::walking_area)
            add_walking_area(lane);
        else if (lane.kind == LaneKind::sidewalk)
            add_sidewalk(lane);
        if (lane.kind == LaneKind::crossing || lane.kind == LaneKind::sidewalk)
            walkways.add_line(lane.centre, walkway_half_width);
        else if (lane.kind != LaneKind::walking_area)
            roads.add_line(lane.centre,
                           std::max(lane.width / 2,
                                    lane.kind == LaneKind::internal ? turning_half : narrowest));
        add_level(lane);
    }
}

void PlacementContext::add_walking_area(const LaneT& lane) {
    walks.add_polygon(lane.outline);
    paved.add_polygon(lane.outline);
}

void PlacementContext::add_sidewalk(const LaneT& lane) {
    walks.add_line(lane.centre, lane.width / 2);
    for (std::size_t i = 1; i < lane.centre.size(); ++i) {
        const Vector2d from = world::in_plan(lane.centre[i - 1]);
        const Vector2d along = world::in_plan(lane.centre[i]) - from;
        paved.add_footprint(
            {from + along / 2, std::atan2(along.y(), along.x()), along.norm(), lane.width});
    }
}

/// Two strips side by side a body: quicker than polygons, and 0.15 m short of their corners.
void PlacementContext::add_swept_area() {
    constexpr double from_end = 0.45;  // [m]
    for (const ground::SweptBody& body : ground::bus_bodies(town)) {
        const double half_strip = body.width / 4;
        const Vector2d along = world::ahead_of(body.yaw) * (body.length / 2 - from_end);
        const Vector2d aside = world::left_of(body.yaw) * half_strip;
        for (const Vector2d& middle :
             {Vector2d(body.centre + aside), Vector2d(body.centre - aside)})
            roads.add_line(middle - along, middle + along, half_strip);
    }
}

void PlacementContext::add_level(const LaneT& lane) {
    const world::LaneStarts starts(lane);
    for (double s = 0; s < lane.length + level_cell / 2; s += level_cell / 2) {
        const Eigen::Vector3d p = starts.at(lane, s).position;
        const Levels here{p.z(), p.z()};
        Levels& cell = levels_.emplace(level_cell_of(p.head<2>()), here).first->second;
        cell = {std::min(cell.low, p.z()), std::max(cell.high, p.z())};
    }
}

void PlacementContext::add_sights() {
    // A junction where somebody must give way, and no light says who.
    std::vector<char> unlit(town.junctions.size(), 0);
    for (const LaneT& lane : town.lanes)
        for (const world::Link& link : lane.links)
            if (lane.kind == LaneKind::driving && lane.junction != world::none && link.yields() &&
                !town.junctions[lane.junction].lit)
                unlit[lane.junction] = 1;
    const double side = town.left_hand ? 1 : -1;
    for (const LaneT& lane : town.lanes) {
        if (lane.kind != LaneKind::driving || lane.junction == world::none ||
            unlit[lane.junction] == 0)
            continue;
        sights.add_point(kerb_point(lane, lane.length, side));
        for (const world::Link& link : lane.links)
            sights.add_point(kerb_point(town.lanes[link.to()], 0, side));
    }
}

bool PlacementContext::is_steep(const Vector2d& p) const {
    const auto middle = level_cell_of(p);
    double low = 1e9;
    double high = -1e9;
    for (std::int32_t x = middle.first - 1; x <= middle.first + 1; ++x)
        for (std::int32_t y = middle.second - 1; y <= middle.second + 1; ++y)
            if (const auto cell = levels_.find({x, y}); cell != levels_.end()) {
                low = std::min(low, cell->second.low);
                high = std::max(high, cell->second.high);
            }
    return high - low > level_apart;
}

bool PlacementContext::is_outside(const Vector2d& p) const {
    constexpr std::int32_t cells = 3;
    const auto middle = level_cell_of(p);
    for (std::int32_t x = middle.first - cells; x <= middle.first + cells; ++x)
        for (std::int32_t y = middle.second - cells; y <= middle.second + cells; ++y)
            if (levels_.contains({x, y}))
                return false;
    return true;
}

bool PlacementContext::is_rural(const Roadside& roadside) const {
    if (roadside.driven == world::none)
        return false;
    std::uint32_t lane = roadside.driven;
    for (const bool to_left : {true, false})
        for (;;) {
            if (town.lanes[lane].opposite != world::none)
                return town.lanes[lane].speed_limit > country_speed;
            const std::uint32_t next = to_left ? town.lanes[lane].left : town.lanes[lane].right;
            if (next == world::none)
                break;
            lane = next;
        }
    return roadside.walk == 0 || town.lanes[lane].speed_limit > country_speed;
}

double PlacementContext::level_ground(const Vector2d& p, double road_z) const {
    return road_z + (walks.is_clear(p, 0) ? -ground::terrain_depth : ground::kerb_height);
}

double PlacementContext::ground(const Vector2d& p, double road_z) const {
    const double wish = level_ground(p, road_z);
    return ground_heights.at(p, wish).value_or(wish);
}

double PlacementContext::drop(const Vector2d& p, double road_z) const {
    return level_ground(p, road_z) - ground(p, road_z);
}

bool PlacementContext::may_stand(const Vector2d& p, double margin) const {
    if (!roads.is_clear(p, margin) || !crossings.is_clear(p, 0.1))
        return false;
    // The outline of a junction holds its walking areas; the rest of it is road.
    return !paved.is_clear(p, 0) || junctions.is_clear(p, 0.1);
}

bool PlacementContext::leaves_walkway_free(const Vector2d& p) const {
    constexpr double at_kerb = 0.75;
    constexpr double at_edge = 0.35;
    if (walks.is_clear(p, 0))
        return true;
    if (!walkways.is_clear(p, towns::pole_radius))
        return false;
    if (!roads.is_clear(p, at_kerb))
        return true;
    // At the outer edge the land begins within a step.
    for (int k = 0; k < directions; ++k) {
        const Vector2d step = p + direction(k) * at_edge;
        if (walks.is_clear(step, 0) && crossings.is_clear(step, 0))
            return true;
    }
    return false;
}

std::optional<Vector2d> PlacementContext::pole_place(const Vector2d& wish,
                                                     double reach,
                                                     double road_z) const {
    constexpr double ring = 0.3;
    constexpr double about_level = 1;  // [m]
    const auto is_level = [&](const Vector2d& p) {
        return std::abs(drop(p, road_z)) < about_level;
    };
    for (const auto& [out_of_the_way, on_level] :
         {std::pair{true, true}, {false, true}, {false, false}})
        for (int i = 0; i * ring <= reach; ++i)
            for (int k = 0; k < (i == 0 ? 1 : directions); ++k) {
                const Vector2d p = wish + direction(k) * (i * ring);
                if (may_stand(p, pole_margin) && solid.is_clear(p, 0.3) &&
                    (!out_of_the_way || leaves_walkway_free(p)) && (!on_level || is_level(p)))
                    return p;
            }
    return std::nullopt;
}

}  // namespace reprise::towns
