#pragma once

#include <array>

#include "ground/mesh/ground.h"
#include "towns/check/walk_tile.h"
#include "world/geometry2d.h"

namespace reprise::towns {

/// Recast's coordinates: x east, y up, z south, from `origin`; single precision.
std::array<float, 3> to_recast(const Eigen::Vector3d& p_world, const Eigen::Vector3d& origin);
Eigen::Vector3d from_recast(const float* p, const Eigen::Vector3d& origin);

/// The ground of a town, cut into squares that are built on their own: memory does not grow with
/// the town.
class WalkTiles {
  public:
    /// Looks into `ground`, which must outlive it.
    explicit WalkTiles(const ground::GroundMesh& ground);

    const Eigen::Vector3d& origin() const { return origin_; }  ///< least corner of all ground

    double edge() const { return edge_; }  ///< [m] of a square

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    /// Columns run east, rows run south from the north edge, as Recast's z does.
    WalkTile build(int column, int row) const;

  private:
    const ground::GroundMesh* ground_;
    world::BoxGrid by_place_;
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    double edge_ = 0;
    int columns_ = 0;
    int rows_ = 0;
};

}  // namespace reprise::towns
