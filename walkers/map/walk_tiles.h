#pragma once

#include <array>
#include <span>
#include <vector>

#include "ground/mesh/ground.h"
#include "walkers/map/walk_tile.h"
#include "world/geometry2d.h"
#include "world/obstacle.h"

namespace reprise::walkers {

/// Recast's coordinates: x east, y up, z south, from `origin`; single precision.
std::array<float, 3> to_recast(const Eigen::Vector3d& p_world, const Eigen::Vector3d& origin);
Eigen::Vector3d from_recast(const float* p, const Eigen::Vector3d& origin);

/// The ground of a town, cut into squares that are built on their own: memory does not grow with
/// the town.
class WalkTiles {
  public:
    /// Looks into `ground`, which must outlive it. `holes`: what stands there; `crossings`: where
    /// the road is for walkers, as convex outlines. A square has at least `smallest_edge` cells
    /// along its sides.
    WalkTiles(const ground::GroundMesh& ground,
              const TileRules& rules,
              std::span<const world::Obstacle> holes = {},
              std::span<const world::Loop> crossings = {},
              int smallest_edge = 256);

    const Eigen::Vector3d& origin() const { return origin_; }  ///< least corner of all ground

    double edge() const { return edge_; }  ///< [m] of a square

    int edge_in_cells() const { return cells_; }

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    /// Columns run east, rows run south from the north edge, as Recast's z does.
    WalkTile build(int column, int row) const;

  private:
    void add_shapes(const world::Box& box, TileTriangles& triangles) const;

    /// In plan, with the heights between which it stands in the way.
    struct Shape {
        world::Loop outline;
        double low = 0;
        double high = 0;
    };

    static Shape shape_of(const world::Obstacle& obstacle);

    const ground::GroundMesh* ground_;
    TileRules rules_;
    std::vector<Shape> shapes_;  ///< holes, and behind them crossings
    std::size_t holes_ = 0;
    world::BoxGrid shapes_by_place_;
    world::BoxGrid by_place_;
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    double edge_ = 0;
    int cells_ = 0;  ///< along the sides of a square
    int columns_ = 0;
    int rows_ = 0;
};

}  // namespace reprise::walkers
