// Must: turn triangles into walkable polygons, the same bytes every time.
// Assumes: triangles face up; sidewalks lie a kerb above the road.
// Goes: Recast's steps in their usual order, on a tile with a margin around it, so that tiles fit
//   together. Areas are given, not found by slope.
// Keeps: parameters measured on real towns.
#include "walkers/map/walk_tile.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/Recast.h>

#include "walkers/map/owned.h"
#include "world/check.h"

namespace reprise::walkers {

namespace {

constexpr float cell_height = 0.05F;  // [m]

void require(bool done, const char* stage) {
    REPRISE_CHECK(done, std::string("walk map: ") + stage);
}

rcConfig make_config(const TilePlace& place, const TileRules& rules) {
    rcConfig config{};
    config.cs = rules.cell;
    config.walkableHeight =
        static_cast<int>(std::ceil(walker_height / static_cast<double>(cell_height)));
    config.walkableClimb =
        static_cast<int>(std::floor(walker_climb / static_cast<double>(cell_height) + 0.5));
    config.walkableRadius = rules.radius;
    config.ch = cell_height;
    config.maxEdgeLen = 40;
    config.maxSimplificationError = rules.simplification;
    config.minRegionArea = 16;
    config.mergeRegionArea = 100;
    config.maxVertsPerPoly = 6;
    config.detailSampleDist = 6;
    config.detailSampleMaxError = 1;
    config.borderSize = rules.margin();
    config.width = config.height = place.cells + 2 * rules.margin();
    std::copy_n(place.low.data(), 3, config.bmin);
    std::copy_n(place.high.data(), 3, config.bmax);
    return config;
}

using Compact = Owned<rcCompactHeightfield, rcFreeCompactHeightfield>;
using Polygons = Owned<rcPolyMesh, rcFreePolyMesh>;
using Details = Owned<rcPolyMeshDetail, rcFreePolyMeshDetail>;

bool is_inside(const TileShape& shape, float x, float z) {
    bool inside = false;
    const std::vector<float>& c = shape.corners;
    for (std::size_t i = 0, j = c.size() - 3; i < c.size(); j = i, i += 3)
        if ((c[i + 2] > z) != (c[j + 2] > z) &&
            x < (c[j] - c[i]) * (z - c[i + 2]) / (c[j + 2] - c[i + 2]) + c[i])
            inside = !inside;
    return inside;
}

/// Gives each walkable cell in some columns another area.
template <typename Change>
void change_areas(rcCompactHeightfield& cells, const TileShape* shape, Change&& change) {
    float low[] = {cells.bmin[0], cells.bmin[2]};
    float high[] = {cells.bmax[0], cells.bmax[2]};
    for (std::size_t i = 0; shape != nullptr && i < shape->corners.size(); i += 3)
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const float at = shape->corners[i + 2 * axis];
            low[axis] = i == 0 ? at : std::min(low[axis], at);
            high[axis] = i == 0 ? at : std::max(high[axis], at);
        }
    const auto cell_of = [&](float at, float start, int count) {
        return std::clamp(static_cast<int>((at - start) / cells.cs), 0, count - 1);
    };
    for (int z = cell_of(low[1], cells.bmin[2], cells.height);
         z <= cell_of(high[1], cells.bmin[2], cells.height);
         ++z)
        for (int x = cell_of(low[0], cells.bmin[0], cells.width);
             x <= cell_of(high[0], cells.bmin[0], cells.width);
             ++x) {
            if (shape != nullptr &&
                !is_inside(*shape,
                           cells.bmin[0] + (static_cast<float>(x) + 0.5F) * cells.cs,
                           cells.bmin[2] + (static_cast<float>(z) + 0.5F) * cells.cs))
                continue;
            const rcCompactCell& column = cells.cells[x + z * cells.width];
            const unsigned first = column.index;
            for (unsigned i = first; i < first + column.count; ++i) {
                const float y = cells.bmin[1] + static_cast<float>(cells.spans[i].y) * cells.ch;
                if (shape == nullptr || (y >= shape->low && y <= shape->high))
                    change(cells.areas[i]);
            }
        }
}

/// Takes out what stands there; of roads, where they do not count, all but the crossings.
void set_areas(const TileTriangles& triangles,
               const TileRules& rules,
               rcCompactHeightfield& cells) {
    for (const TileShape& shape : triangles.crossings)
        change_areas(cells, &shape, [](unsigned char& area) {
            if (area != RC_NULL_AREA)
                area = walk_crossing;
        });
    if (!rules.roads)
        change_areas(cells, nullptr, [](unsigned char& area) {
            if (area == walk_road)
                area = RC_NULL_AREA;
        });
    for (const TileShape& shape : triangles.holes)
        change_areas(cells, &shape, [](unsigned char& area) { area = RC_NULL_AREA; });
}

/// The walkable cells of a tile, with a body's radius taken off along every edge.
Compact make_cells(rcContext& context,
                   const rcConfig& config,
                   const TileTriangles& triangles,
                   const TileRules& rules) {
    Owned<rcHeightfield, rcFreeHeightField> solid(rcAllocHeightfield());
    require(rcCreateHeightfield(&context,
                                *solid,
                                config.width,
                                config.height,
                                config.bmin,
                                config.bmax,
                                config.cs,
                                config.ch),
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
    set_areas(triangles, rules, *cells);
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
                                const TilePlace& place,
                                const TileRules& rules) {
    dtNavMeshCreateParams params{};
    params.verts = polygons.verts;
    params.vertCount = polygons.nverts;
    params.polys = polygons.polys;
    params.polyAreas = polygons.areas;
    params.polyFlags = polygons.flags;
    params.polyCount = polygons.npolys;
    params.nvp = polygons.nvp;
    if (rules.heights) {
        params.detailMeshes = details.meshes;
        params.detailVerts = details.verts;
        params.detailVertsCount = details.nverts;
        params.detailTris = details.tris;
        params.detailTriCount = details.ntris;
    }
    params.walkableHeight = static_cast<float>(walker_height);
    params.walkableRadius = static_cast<float>(walker_radius);
    params.walkableClimb = static_cast<float>(walker_climb);
    params.tileX = place.column;
    params.tileY = place.row;
    std::copy_n(polygons.bmin, 3, params.bmin);
    std::copy_n(polygons.bmax, 3, params.bmax);
    params.cs = rules.cell;
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

WalkTile make_walk_tile(const TileTriangles& triangles,
                        const TilePlace& place,
                        const TileRules& rules) {
    rcContext context(false);  // no log, no clock
    const rcConfig config = make_config(place, rules);
    const Compact cells = make_cells(context, config, triangles, rules);
    const Polygons polygons = make_polygons(context, config, *cells);
    if (polygons->npolys == 0)
        return {};
    const Details details(rcAllocPolyMeshDetail());
    if (rules.heights)
        require(rcBuildPolyMeshDetail(&context,
                                      *polygons,
                                      *cells,
                                      config.detailSampleDist,
                                      config.detailSampleMaxError,
                                      *details),
                "details");
    return {pack(*polygons, *details, place, rules), static_cast<std::size_t>(polygons->npolys)};
}

}  // namespace reprise::walkers
