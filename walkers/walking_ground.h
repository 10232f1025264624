#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ground/mesh/ground.h"
#include "ground/mesh/ground_probe.h"
#include "walkers/map/walk_map.h"
#include "world/obstacle.h"
#include "world/town.h"

namespace reprise::walkers {

/// The ground of a town as people on foot use it. Two walk maps: the pavement ends at kerbs, so who
/// goes by it never leaves sidewalks and crossings; the streets have the roads as well. Both leave
/// out what stands there, and both are made when first asked for: a pure function of the town.
class WalkingGround {
  public:
    /// `town` must outlive this, and so must `mesh`, its ground, where that was made already.
    explicit WalkingGround(const world::TownT& town, const ground::GroundMesh* mesh = nullptr);
    WalkingGround(const WalkingGround&) = delete;
    WalkingGround& operator=(const WalkingGround&) = delete;

    /// Town 1: 0.6 s of CPU time, as streets(), by all cores.
    const WalkMap& pavement();
    const WalkMap& streets();

    const std::vector<world::Obstacle>& obstacles() const { return obstacles_; }

    /// [m] of the ground at or just below this place; its own height where there is none. `around`:
    /// of the one who asks, kept from step to step.
    double height(const Eigen::Vector3d& p_world, ground::GroundProbe::Around& around) const;

  private:
    WalkMap make(bool roads) const;

    const world::TownT* town_;
    std::optional<ground::GroundMesh> own_mesh_;
    const ground::GroundMesh* mesh_;
    ground::GroundProbe probe_;
    std::vector<world::Obstacle> obstacles_;
    std::optional<WalkMap> pavement_;
    std::optional<WalkMap> streets_;
};

}  // namespace reprise::walkers
