// Must: turn triangles into walkable polygons, the same bytes every time.
// Assumes: triangles face up; sidewalks lie a kerb above the road.
// Goes: Recast's steps in their usual order, on a tile with a margin around it, so that tiles fit
//   together. Areas are given, not found by slope.
// Keeps: parameters measured on real towns.
#include "towns/check/walk_tile.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/Recast.h>

#include "towns/check/owned.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

constexpr float cell_height = 0.05F;  // [m]

void require(bool done, const char* stage) {
    REPRISE_CHECK(done, std::string("walk map: ") + stage);
}

rcConfig make_config(const TilePlace& place) {
    rcConfig config{};
    config.cs = tile_cell;
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
    config.borderSize = tile_margin;
    config.width = config.height = place.cells + 2 * tile_margin;
    std::copy_n(place.low.data(), 3, config.bmin);
    std::copy_n(place.high.data(), 3, config.bmax);
    return config;
}

using Compact = Owned<rcCompactHeightfield, rcFreeCompactHeightfield>;
using Polygons = Owned<rcPolyMesh, rcFreePolyMesh>;
using Details = Owned<rcPolyMeshDetail, rcFreePolyMeshDetail>;

/// The walkable cells of a tile, with a body's radius taken off along every edge.
Compact make_cells(rcContext& context, const rcConfig& config, const TileTriangles& triangles) {
    Owned<rcHeightfield, rcFreeHeightField> solid(rcAllocHeightfield());
    require(rcCreateHeightfield(&context,
                                *solid,
                                config.width,
                                config.height,
                                config.bmin,
                                config.bmax,
                                tile_cell,
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
                                const TilePlace& place) {
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
    params.tileX = place.column;
    params.tileY = place.row;
    std::copy_n(polygons.bmin, 3, params.bmin);
    std::copy_n(polygons.bmax, 3, params.bmax);
    params.cs = tile_cell;
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

WalkTile make_walk_tile(const TileTriangles& triangles, const TilePlace& place) {
    rcContext context(false);  // no log, no clock
    const rcConfig config = make_config(place);
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
    return {pack(*polygons, *details, place), static_cast<std::size_t>(polygons->npolys)};
}

}  // namespace reprise::towns
