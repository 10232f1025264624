// Must: turn ground into walkable polygons, tile by tile, the same bytes every time.
// Assumes: triangles face up; sidewalks lie a kerb above the road.
// Goes: Recast's steps in their usual order, on each tile with a margin around it, so that tiles
// fit
//   together. Areas are given, not found by slope. Terrain and kerb faces are left out.
// Keeps: parameters measured on real towns: 0.3 m cells (0.15 m gave the same answers at three
//   times the cost).
#include "traffic/walk_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/Recast.h>

#include "world/check.h"

namespace reprise::traffic {

namespace {

using world::Surface;

constexpr float cell = 0.3F;          // [m] in plan
constexpr float cell_height = 0.05F;  // [m]
constexpr int margin = 5;             // [cells] around a tile: its radius, and room for erosion
constexpr int smallest_tile = 256;    // [cells]
constexpr double most_tiles = 900;    // a reference of Detour has 22 bits for tile and polygon

template <typename T, void (*release)(T*)>
struct Release {
    void operator()(T* thing) const { release(thing); }
};

template <typename T, void (*release)(T*)>
using Owned = std::unique_ptr<T, Release<T, release>>;

/// 0: nobody walks there.
unsigned char area_of(Surface surface) {
    switch (surface) {
        case Surface::road:
            return walk_road;
        case Surface::crossing:
            return walk_crossing;
        case Surface::sidewalk:
            return walk_sidewalk;
        default:
            return 0;
    }
}

struct Triangles {
    std::vector<float> vertices;
    std::vector<int> corners;
    std::vector<unsigned char> areas;

    int count() const { return static_cast<int>(areas.size()); }
};

/// The ground in and around a tile.
Triangles triangles_in(const world::GroundMesh& ground,
                       const world::BoxGrid& by_place,
                       const world::Box& box,
                       const Eigen::Vector3d& origin) {
    Triangles triangles;
    for (const std::uint32_t i : by_place.near(box)) {
        world::Box own;
        for (const std::uint32_t vertex : ground.triangles[i])
            own.take(ground.vertices[vertex].head<2>());
        if ((own.low.array() > box.high.array()).any() ||
            (own.high.array() < box.low.array()).any())
            continue;
        for (const std::uint32_t vertex : ground.triangles[i]) {
            triangles.corners.push_back(static_cast<int>(triangles.vertices.size() / 3));
            for (const float coordinate : to_recast(ground.vertices[vertex], origin))
                triangles.vertices.push_back(coordinate);
        }
        triangles.areas.push_back(area_of(ground.surfaces[i]));
    }
    return triangles;
}

void require(bool done, const char* step) {
    REPRISE_CHECK(done, std::string("walk map: ") + step);
}

rcConfig make_config(const float* low, const float* high, int tile_cells) {
    rcConfig config{};
    config.cs = cell;
    config.ch = cell_height;
    config.walkableHeight =
        static_cast<int>(std::ceil(walker_height / static_cast<double>(cell_height)));
    config.walkableClimb =
        static_cast<int>(std::floor(walker_climb / static_cast<double>(cell_height) + 0.5));
    config.walkableRadius = 1;
    config.maxEdgeLen = 40;
    config.maxSimplificationError = 1.0F;
    config.minRegionArea = 16;
    config.mergeRegionArea = 100;
    config.maxVertsPerPoly = 6;
    config.detailSampleDist = 6;
    config.detailSampleMaxError = 1;
    config.borderSize = margin;
    config.width = config.height = tile_cells + 2 * margin;
    std::copy_n(low, 3, config.bmin);
    std::copy_n(high, 3, config.bmax);
    return config;
}

using Compact = Owned<rcCompactHeightfield, rcFreeCompactHeightfield>;
using Polygons = Owned<rcPolyMesh, rcFreePolyMesh>;
using Details = Owned<rcPolyMeshDetail, rcFreePolyMeshDetail>;

/// The walkable cells of a tile, with a body's radius taken off along every edge.
Compact make_cells(rcContext& context, const rcConfig& config, const Triangles& triangles) {
    Owned<rcHeightfield, rcFreeHeightField> solid(rcAllocHeightfield());
    require(rcCreateHeightfield(&context,
                                *solid,
                                config.width,
                                config.height,
                                config.bmin,
                                config.bmax,
                                cell,
                                cell_height),
            "heightfield");
    require(rcRasterizeTriangles(&context,
                                 triangles.vertices.data(),
                                 static_cast<int>(triangles.vertices.size() / 3),
                                 triangles.corners.data(),
                                 triangles.areas.data(),
                                 triangles.count(),
                                 *solid,
                                 config.walkableClimb),
            "cells");
    Compact cells(rcAllocCompactHeightfield());
    require(rcBuildCompactHeightfield(
                &context, config.walkableHeight, config.walkableClimb, *solid, *cells),
            "compact cells");
    require(rcErodeWalkableArea(&context, config.walkableRadius, *cells), "erosion");
    require(rcBuildDistanceField(&context, *cells), "distances");
    require(rcBuildRegions(
                &context, *cells, config.borderSize, config.minRegionArea, config.mergeRegionArea),
            "regions");
    return cells;
}

Polygons make_polygons(rcContext& context, const rcConfig& config, rcCompactHeightfield& cells) {
    Owned<rcContourSet, rcFreeContourSet> contours(rcAllocContourSet());
    require(rcBuildContours(
                &context, cells, config.maxSimplificationError, config.maxEdgeLen, *contours),
            "contours");
    Polygons polygons(rcAllocPolyMesh());
    require(rcBuildPolyMesh(&context, *contours, config.maxVertsPerPoly, *polygons), "polygons");
    for (int i = 0; i < polygons->npolys; ++i)
        polygons->flags[i] = 1;
    return polygons;
}

/// Detour's own format.
std::vector<unsigned char> pack(const rcPolyMesh& polygons,
                                const rcPolyMeshDetail& details,
                                int column,
                                int row) {
    dtNavMeshCreateParams params{};
    params.verts = polygons.verts;
    params.vertCount = polygons.nverts;
    params.polys = polygons.polys;
    params.polyAreas = polygons.areas;
    params.polyFlags = polygons.flags;
    params.polyCount = polygons.npolys;
    params.nvp = polygons.nvp;
    params.detailMeshes = details.meshes;
    params.detailVerts = details.verts;
    params.detailVertsCount = details.nverts;
    params.detailTris = details.tris;
    params.detailTriCount = details.ntris;
    params.walkableHeight = static_cast<float>(walker_height);
    params.walkableRadius = static_cast<float>(walker_radius);
    params.walkableClimb = static_cast<float>(walker_climb);
    params.tileX = column;
    params.tileY = row;
    std::copy_n(polygons.bmin, 3, params.bmin);
    std::copy_n(polygons.bmax, 3, params.bmax);
    params.cs = cell;
    params.ch = cell_height;
    params.buildBvTree = true;
    unsigned char* data = nullptr;
    int size = 0;
    require(dtCreateNavMeshData(&params, &data, &size), "packing");
    std::vector<unsigned char> bytes(data, data + size);
    dtFree(data);
    return bytes;
}

}  // namespace

std::array<float, 3> to_recast(const Eigen::Vector3d& p_world, const Eigen::Vector3d& origin) {
    const Eigen::Vector3d p = p_world - origin;
    return {static_cast<float>(p.x()), static_cast<float>(p.z()), static_cast<float>(-p.y())};
}

Eigen::Vector3d from_recast(const float* p, const Eigen::Vector3d& origin) {
    return origin + Eigen::Vector3d(static_cast<double>(p[0]),
                                    static_cast<double>(-p[2]),
                                    static_cast<double>(p[1]));
}

WalkTiles::WalkTiles(const world::GroundMesh& ground) : ground_(&ground) {
    std::vector<world::BoxGrid::Entry> entries;
    world::Box all;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < ground.triangles.size(); ++i) {
        if (area_of(ground.surfaces[i]) == 0)
            continue;
        world::Box box;
        for (const std::uint32_t vertex : ground.triangles[i]) {
            box.take(ground.vertices[vertex].head<2>());
            lowest = std::min(lowest, ground.vertices[vertex].z());
        }
        all.take(box);
        entries.push_back({box, i});
    }
    if (entries.empty())
        return;
    by_place_ = world::BoxGrid(entries);
    const Eigen::Vector2d size = all.high - all.low;
    // North-west corner: rows run south.
    origin_ = {all.low.x(), all.high.y(), lowest};
    const double least_edge = std::sqrt(size.prod() / most_tiles);
    const int cells = std::max(smallest_tile,
                               static_cast<int>(std::ceil(least_edge / static_cast<double>(cell))));
    edge_ = cells * static_cast<double>(cell);
    columns_ = 1 + static_cast<int>(size.x() / edge_);
    rows_ = 1 + static_cast<int>(size.y() / edge_);
}

WalkTile WalkTiles::build(int column, int row) const {
    const double border = margin * static_cast<double>(cell);
    const Eigen::Vector2d north_west = origin_.head<2>() + edge_ * Eigen::Vector2d(column, -row);
    world::Box box;
    box.take(north_west, border);
    box.take(north_west + Eigen::Vector2d(edge_, -edge_), border);
    const Triangles triangles = triangles_in(*ground_, by_place_, box, origin_);
    if (triangles.count() == 0)
        return {};
    std::array<float, 3> low = to_recast({box.low.x(), box.high.y(), 0}, origin_);
    std::array<float, 3> high = to_recast({box.high.x(), box.low.y(), 0}, origin_);
    low[1] = high[1] = triangles.vertices[1];
    for (std::size_t i = 1; i < triangles.vertices.size(); i += 3) {
        low[1] = std::min(low[1], triangles.vertices[i]);
        high[1] = std::max(high[1], triangles.vertices[i]);
    }
    high[1] += static_cast<float>(walker_height) + 1;

    rcContext context(false);  // no log, no clock
    const int cells_a_side = static_cast<int>(std::lround(edge_ / static_cast<double>(cell)));
    const rcConfig config = make_config(low.data(), high.data(), cells_a_side);
    const Compact cells = make_cells(context, config, triangles);
    const Polygons polygons = make_polygons(context, config, *cells);
    if (polygons->npolys == 0)
        return {};
    const Details details(rcAllocPolyMeshDetail());
    require(rcBuildPolyMeshDetail(&context,
                                  *polygons,
                                  *cells,
                                  config.detailSampleDist,
                                  config.detailSampleMaxError,
                                  *details),
            "details");
    return {pack(*polygons, *details, column, row), static_cast<std::size_t>(polygons->npolys)};
}

}  // namespace reprise::traffic
