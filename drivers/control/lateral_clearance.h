#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"
#include "world/obstacle.h"
#include "world/town.h"

namespace reprise::drivers {

/// How far the road reaches to one side of a place, across it. [m], at most what
/// LateralClearances sees.
struct LateralClearance {
    double to_kerb = 0;      ///< to the first sidewalk
    double to_verge = 0;     ///< to where no more road is: grass
    double to_obstacle = 0;  ///< to the first thing that stands: pole, trunk, wall, building
    double to_waiting = 0;   ///< to a lane of the other direction, where one waits at its end
};

/// Looks across the road for kerbs, and for what stands behind them.
class LateralClearances {
  public:
    static constexpr double sight = 6;  ///< [m]

    /// Looks into `town` and `lanes`, which must outlive this. O(obstacles).
    LateralClearances(const world::TownT& town,
                      const world::LaneMap& lanes,
                      std::span<const world::Obstacle> obstacles);

    /// From p_world towards `side` (unit, in plan). About 10 us.
    /// Things count from half a metre beside the line on: lines half a metre apart miss none.
    LateralClearance look(const Eigen::Vector3d& p_world, const Eigen::Vector2d& side) const;

    /// The `to_waiting` of it, where one who drives that way (`ahead`, unit, in plan) passes there.
    double look_for_line(const Eigen::Vector3d& p_world,
                         const Eigen::Vector2d& side,
                         const Eigen::Vector2d& ahead) const;

    /// Does nothing stand within `reach` [m] of the straight line between them?
    bool is_clear(const Eigen::Vector3d& from_world,
                  const Eigen::Vector3d& to_world,
                  double reach) const;

  private:
    /// Seen from above: an outline, a line or a point, and how far it reaches beyond.
    struct Thing {
        world::Loop outline;
        double radius = 0;
        double z = 0;
    };

    bool is_sidewalk(const Eigen::Vector3d& p_world) const;
    bool is_before_line(const Eigen::Vector3d& p_world, const Eigen::Vector2d& against) const;
    static bool is_on_level(const Thing& thing, double z);
    bool is_road(const Eigen::Vector3d& p_world) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    std::vector<Thing> things_;
    world::BoxGrid things_by_place_;
    std::vector<world::Loop> junctions_;  ///< outlines
    world::BoxGrid junctions_by_place_;
};

}  // namespace reprise::drivers
