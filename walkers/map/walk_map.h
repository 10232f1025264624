#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "ground/mesh/ground.h"
#include "world/digest.h"

namespace reprise::towns {

/// Where people can walk, and which way they would go: sidewalks first, crossings where there are
/// any, across the road only where it saves a lot. A navigation mesh (Recast, Detour) of the town's
/// ground in square tiles, for bodies of 0.3 m radius and 1.8 m height who step up 0.3 m.
/// Equal ground gives equal bytes. One thread at a time. Town 1: 0.5 s, 300 kB.
class WalkMap {
  public:
    explicit WalkMap(const ground::GroundMesh& ground);
    ~WalkMap();
    WalkMap(WalkMap&&) noexcept;
    WalkMap& operator=(WalkMap&&) noexcept;

    /// A corner of a way, and what one walks on from here to the next.
    struct Step {
        Eigen::Vector3d position;  ///< world
        ground::Surface surface = ground::Surface::sidewalk;
    };

    /// The cheapest way, corner by corner, with one at every change of surface: a metre of crossing
    /// costs 1.5, a metre of road 10 metres of sidewalk. None: `from` or `to` is more than 2 m from
    /// anything walkable, or nothing leads there.
    std::optional<std::vector<Step>> path(const Eigen::Vector3d& from_world,
                                          const Eigen::Vector3d& to_world) const;

    std::size_t polygons() const;
    std::size_t bytes() const;
    world::Digest128 digest() const;

  private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

}  // namespace reprise::towns
