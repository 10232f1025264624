#include "towns/check/walk_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reprise::towns {

namespace {

using ground::Surface;

constexpr int smallest_tile = 256;  ///< [cells]
constexpr double most_tiles = 900;  ///< a reference of Detour has 22 bits for tile and polygon

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

/// The ground in and around a tile.
TileTriangles triangles_in(const ground::GroundMesh& ground,
                           const world::BoxGrid& by_place,
                           const world::Box& box,
                           const Eigen::Vector3d& origin) {
    TileTriangles triangles;
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

WalkTiles::WalkTiles(const ground::GroundMesh& ground) : ground_(&ground) {
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
    const int cells = std::max(
        smallest_tile, static_cast<int>(std::ceil(least_edge / static_cast<double>(tile_cell))));
    edge_ = cells * static_cast<double>(tile_cell);
    columns_ = 1 + static_cast<int>(size.x() / edge_);
    rows_ = 1 + static_cast<int>(size.y() / edge_);
}

WalkTile WalkTiles::build(int column, int row) const {
    const double border = tile_margin * static_cast<double>(tile_cell);
    const Eigen::Vector2d north_west = origin_.head<2>() + edge_ * Eigen::Vector2d(column, -row);
    world::Box box;
    box.take(north_west, border);
    box.take(north_west + Eigen::Vector2d(edge_, -edge_), border);
    const TileTriangles triangles = triangles_in(*ground_, by_place_, box, origin_);
    if (triangles.count() == 0)
        return {};
    TilePlace place;
    place.column = column;
    place.row = row;
    place.cells = static_cast<int>(std::lround(edge_ / static_cast<double>(tile_cell)));
    place.low = to_recast({box.low.x(), box.high.y(), 0}, origin_);
    place.high = to_recast({box.high.x(), box.low.y(), 0}, origin_);
    place.low[1] = place.high[1] = triangles.vertices[1];
    for (std::size_t i = 1; i < triangles.vertices.size(); i += 3) {
        place.low[1] = std::min(place.low[1], triangles.vertices[i]);
        place.high[1] = std::max(place.high[1], triangles.vertices[i]);
    }
    place.high[1] += static_cast<float>(walker_height) + 1;
    return make_walk_tile(triangles, place);
}

}  // namespace reprise::towns
