#include "walkers/map/walk_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "world/units.h"

namespace reprise::walkers {

namespace {

using ground::Surface;

/// Beyond that no map fits into Detour's references, whatever its polygons: not even tried.
constexpr double most_tiles = 16384;

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

/// [m] What stands there takes up so much more: the mesh's edge may lie a cell nearer to it than a
/// body does (TileRules::simplification). Less beside poles, which stand in narrow places.
constexpr double beside_box = 0.07, beside_pole = 0.05;
constexpr double beside_house = 0.12;  ///< [m] where corners are acute, and cells cut them
constexpr double narrowest = 0.15;     ///< [m] half width of it: seen by a cell's middle
constexpr double step_over = 0.1;      ///< [m] what is lower is in nobody's way

/// A convex outline, wound either way, with every side moved out by `more` [m]; a point no further
/// than five times that.
world::Loop moved_out(const world::Loop& outline, double more) {
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        area += world::cross(outline[i], outline[(i + 1) % outline.size()]);
    const double side = area > 0 ? -1 : 1;
    world::Loop wider;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d& corner = outline[i];
        const Eigen::Vector2d& before = outline[(i + outline.size() - 1) % outline.size()];
        const Eigen::Vector2d& behind = outline[(i + 1) % outline.size()];
        const Eigen::Vector2d out = side * world::turned_left((corner - before).normalized());
        const Eigen::Vector2d next = side * world::turned_left((behind - corner).normalized());
        wider.push_back(corner + more * (out + next) / std::max(1 + out.dot(next), 0.08));
    }
    return wider;
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

WalkTiles::Shape WalkTiles::shape_of(const world::Obstacle& obstacle) {
    Shape shape;
    const Eigen::Vector2d middle = obstacle.position.head<2>();
    shape.low = obstacle.position.z() - 0.5;
    shape.high = obstacle.position.z() + 2 * obstacle.half.z() - obstacle.depth;
    if (obstacle.shape == world::Obstacle::Shape::prism) {
        for (const Eigen::Vector3d& corner : obstacle.corners)
            shape.outline.emplace_back(middle + corner.head<2>());
        shape.outline = moved_out(shape.outline, beside_house);
        return shape;
    }
    const Eigen::Vector2d ahead = world::ahead_of(obstacle.yaw);
    const bool is_box = obstacle.shape == world::Obstacle::Shape::box;
    const double more = is_box ? beside_box : beside_pole;
    const double length = std::max(obstacle.half.x() + more, narrowest);
    const double width = std::max(obstacle.half.y() + more, narrowest);
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
        shape.outline.emplace_back(middle + x * length * ahead +
                                   y * width * world::turned_left(ahead));
    return shape;
}

/// What stands in and around a tile, and the crossings there.
void WalkTiles::add_shapes(const world::Box& box, TileTriangles& triangles) const {
    for (const std::uint32_t i : shapes_by_place_.near(box)) {
        const Shape& shape = shapes_[i];
        TileShape prism;
        for (const Eigen::Vector2d& corner : shape.outline)
            for (const float coordinate : to_recast({corner.x(), corner.y(), 0}, origin_))
                prism.corners.push_back(coordinate);
        prism.low = static_cast<float>(shape.low - origin_.z());
        prism.high = static_cast<float>(shape.high - origin_.z());
        (i < holes_ ? triangles.holes : triangles.crossings).push_back(std::move(prism));
    }
}

WalkTiles::WalkTiles(const ground::GroundMesh& ground,
                     const TileRules& rules,
                     std::span<const world::Obstacle> holes,
                     std::span<const world::Loop> crossings,
                     int smallest_edge)
    : ground_(&ground),
      rules_(rules) {
    for (const world::Obstacle& obstacle : holes)
        if (2 * obstacle.half.z() - obstacle.depth > step_over)
            shapes_.push_back(shape_of(obstacle));
    holes_ = shapes_.size();
    for (const world::Loop& crossing : crossings)
        shapes_.push_back({crossing, -world::infinity, world::infinity});
    std::vector<world::BoxGrid::Entry> by_box;
    for (std::uint32_t i = 0; i < shapes_.size(); ++i)
        by_box.push_back({world::box_around(shapes_[i].outline), i});
    shapes_by_place_ = world::BoxGrid(by_box);

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
    cells_ = std::max(smallest_edge,
                      static_cast<int>(std::ceil(least_edge / static_cast<double>(rules_.cell))));
    edge_ = cells_ * static_cast<double>(rules_.cell);
    columns_ = 1 + static_cast<int>(size.x() / edge_);
    rows_ = 1 + static_cast<int>(size.y() / edge_);
}

WalkTile WalkTiles::build(int column, int row) const {
    const double border = rules_.margin() * static_cast<double>(rules_.cell);
    const Eigen::Vector2d north_west = origin_.head<2>() + edge_ * Eigen::Vector2d(column, -row);
    world::Box box;
    box.take(north_west, border);
    box.take(north_west + Eigen::Vector2d(edge_, -edge_), border);
    TileTriangles triangles = triangles_in(*ground_, by_place_, box, origin_);
    if (triangles.count() == 0)
        return {};
    add_shapes(box, triangles);
    TilePlace place;
    place.column = column;
    place.row = row;
    place.cells = cells_;
    place.low = to_recast({box.low.x(), box.high.y(), 0}, origin_);
    place.high = to_recast({box.high.x(), box.low.y(), 0}, origin_);
    place.low[1] = place.high[1] = triangles.vertices[1];
    for (std::size_t i = 1; i < triangles.vertices.size(); i += 3) {
        place.low[1] = std::min(place.low[1], triangles.vertices[i]);
        place.high[1] = std::max(place.high[1], triangles.vertices[i]);
    }
    place.high[1] += static_cast<float>(walker_height) + 1;
    return make_walk_tile(triangles, place, rules_);
}

}  // namespace reprise::walkers
