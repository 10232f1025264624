// Must: give every lane and every path through a junction a road surface at its own height.
// Assumes: centre lines of at least two points; nothing of junction outlines.
// Goes: lanes are ribbons; a junction is the union of its outline and of the swaths of its internal
//   lanes (real outlines leave holes under turning cars), less its crossings; then slabs.cpp,
//   terrain.cpp under it all, and decks.cpp where something hangs over it. Everything is local,
//   never one map in plan: bridges keep their level.
// Keeps: surfaces of the same level meet or lane_overlap at the same height; there are no cracks.
#include "ground/mesh/build_ground.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ground/mesh/decks.h"
#include "ground/mesh/ground_builder.h"
#include "ground/mesh/junction_surface.h"
#include "ground/mesh/polygons.h"
#include "ground/mesh/ribbon.h"
#include "ground/mesh/slabs.h"
#include "ground/mesh/terrain.h"
#include "world/town.h"

namespace reprise::ground {

namespace {

/// [m] Neighbouring surfaces reach this far into each other, so that no wheel finds the millimetre
/// between them.
constexpr double lane_overlap = 0.02;

double half_road(const world::LaneT& lane) {
    return std::max(lane.width / 2, car_clearance) + lane_overlap;
}

Ribbon road_ribbon(const world::LaneT& lane) {
    return make_ribbon(clean_line(lane.centre, lane_overlap), -half_road(lane), half_road(lane));
}

void add_lanes(const world::TownT& town, GroundBuilder& ground) {
    for (const world::LaneT& lane : town.lanes) {
        const bool is_road = world::is_for_cars(lane) || lane.kind == world::LaneKind::other;
        if (!is_road || is_inside_junction(town, lane))
            continue;
        for (const auto& piece : road_ribbon(lane).pieces)
            ground.add_face(piece, Surface::road);
    }
}

/// Crossings that no junction owns.
void add_lone_crossings(const world::TownT& town, GroundBuilder& ground) {
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::crossing || lane.junction < town.junctions.size())
            continue;
        const Ribbon ribbon = make_ribbon(clean_line(lane.centre), -lane.width / 2, lane.width / 2);
        for (const auto& piece : ribbon.pieces)
            ground.add_face(piece, Surface::crossing);
    }
}

/// Adds one material of a junction.
void add_pieces(const Area& area,
                const SurfaceHeight& surface,
                Surface material,
                GroundBuilder& ground) {
    const auto height = [&](const Eigen::Vector2d& p) { return surface.at(p); };
    const double cell = surface.is_plane() ? 0 : surface_cell;
    for (const world::Loop& piece : area.pieces())
        ground.add_face(piece, height, cell, material);
}

/// Does it climb within its first or last metre?
bool slopes_at(const world::LaneT& lane, double s) {
    constexpr double least = 0.02;  // of slope; less makes no step that a wheel would feel
    const double length = std::min(1.0, lane.length);
    const double from = std::clamp(s - length, 0.0, lane.length - length);
    return std::abs(world::point_at(lane, from + length).position.z() -
                    world::point_at(lane, from).position.z()) > least * length;
}

/// Roads that are not level where they meet a junction: its outline, which is, may reach over them
/// by some decimetres, and would stick out. [junction] of lanes, ascending.
std::vector<std::set<std::uint32_t>> slopes_at_junctions(const world::TownT& town) {
    std::vector<std::set<std::uint32_t>> found(town.junctions.size());
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        if (lane.kind != world::LaneKind::driving || lane.junction >= found.size())
            continue;
        if (slopes_at(lane, lane.length))
            found[lane.junction].insert(i);
        for (const world::Link& link : lane.links)
            if (link.to() < town.lanes.size() &&
                town.lanes[link.to()].kind == world::LaneKind::driving &&
                slopes_at(town.lanes[link.to()], 0))
                found[lane.junction].insert(link.to());
    }
    return found;
}

void add_junction(const world::TownT& town,
                  std::uint32_t junction,
                  const JunctionParts& parts,
                  const std::set<std::uint32_t>& slopes,
                  GroundBuilder& ground) {
    const Eigen::Vector2d origin(std::floor(town.low.x()), std::floor(town.low.y()));
    Area road(origin);
    road.add(world::in_plan(town.junctions[junction].outline));
    Area roads(origin);
    for (const std::uint32_t lane : slopes)
        for (const world::Loop& loop : road_ribbon(town.lanes[lane]).loops())
            roads.add(loop);
    roads.shrink(lane_overlap);
    road.subtract(roads);
    for (const std::uint32_t path : parts.paths)
        for (const world::Loop& loop : road_ribbon(town.lanes[path]).loops())
            road.add(loop);
    Area crossings(origin);
    for (const std::uint32_t crossing : parts.crossings)
        crossings.add(world::in_plan(town.lanes[crossing].outline));

    // The road reaches a little under the crossings' borders: corners are rounded to millimetres,
    // so that borders which merely meet would leave cracks.
    Area without = crossings.copy();
    without.shrink(lane_overlap);
    road.subtract(without);

    const SurfaceHeight surface = height_of_junction(town, junction, parts);
    add_pieces(road, surface, Surface::road, ground);
    add_pieces(crossings, surface, Surface::crossing, ground);
}

void add_junctions(const world::TownT& town, GroundBuilder& ground) {
    const std::vector<JunctionParts> parts = parts_of_junctions(town);
    const std::vector<std::set<std::uint32_t>> slopes = slopes_at_junctions(town);
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        add_junction(town, i, parts[i], slopes[i], ground);
}

}  // namespace

GroundMesh build_ground(const world::TownT& town) {
    GroundBuilder ground;
    add_lanes(town, ground);
    add_lone_crossings(town, ground);
    add_junctions(town, ground);
    add_slabs(town, ground);
    add_terrain(town, ground);
    add_decks(town, ground);
    return ground.take();
}

}  // namespace reprise::ground
