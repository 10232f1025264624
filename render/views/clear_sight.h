#pragma once

#include <vector>

#include <Eigen/Core>

#include "ground/mesh/ground.h"
#include "ground/mesh/ground_probe.h"
#include "world/geometry2d.h"
#include "world/obstacle.h"
#include "world/town_generated.h"

namespace reprise::render {

/// What stands in the way of somebody who looks on: buildings, walls, parked vehicles and the
/// ground. Not trunks and poles, which are past in a moment.
class ClearSight {
  public:
    explicit ClearSight(const world::TownT& town);

    /// How far one gets on the straight way from one point to another before something is nearer
    /// than half a metre: a share, 1 is all the way. What holds `from` itself does not count.
    double share(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// The place, or the one a metre above the ground when it is lower: above that level of the
    /// ground on which `foot` is.
    Eigen::Vector3d above_ground(const Eigen::Vector3d& foot, Eigen::Vector3d place) const;

  private:
    struct Block {
        world::Loop outline;  ///< convex, counter-clockwise
        double low;
        double high;
    };

    static Block block_of(const world::Obstacle& obstacle);

    std::vector<Block> blocks_;
    world::BoxGrid by_place_;
    ground::GroundMesh ground_;
    ground::GroundProbe probe_;
};

}  // namespace reprise::render
