#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "ground/mesh/ground.h"
#include "walkers/map/walk_tile.h"
#include "world/digest.h"
#include "world/geometry2d.h"
#include "world/obstacle.h"

namespace reprise::walkers {

/// Where people can walk, and which way they would go: sidewalks first, crossings where there are
/// any, across the road only where it saves a lot. A navigation mesh (Recast, Detour) of the town's
/// ground in square tiles, for bodies of 0.3 m radius and 1.8 m height who step up 0.3 m.
/// Equal ground gives equal bytes. One thread at a time. Town 1: 0.5 s, 300 kB.
class WalkMap {
  public:
    /// `obstacles` are walked around; `crossings`, convex outlines, are crossing whatever the
    /// ground says. A mesh without roads (`rules`) ends at kerbs and at the sides of crossings.
    explicit WalkMap(const ground::GroundMesh& ground,
                     const TileRules& rules = {},
                     std::span<const world::Obstacle> obstacles = {},
                     std::span<const world::Loop> crossings = {});
    ~WalkMap();
    WalkMap(WalkMap&&) noexcept;
    WalkMap& operator=(WalkMap&&) noexcept;

    /// A corner of a way, and what one walks on from here to the next.
    struct Step {
        Eigen::Vector3d position;  ///< world
        ground::Surface surface = ground::Surface::sidewalk;
    };

    /// What a metre of them is worth, in metres of sidewalk; 1 at least.
    struct Costs {
        double crossing = 1.5;
        double road = 10;
    };

    /// The cheapest way, corner by corner, with one at every change of surface. None: `from` or
    /// `to` is more than 2 m from anything walkable, or nothing leads there.
    std::optional<std::vector<Step>> path(const Eigen::Vector3d& from_world,
                                          const Eigen::Vector3d& to_world) const;

    /// A place on the mesh.
    struct Place {
        std::uint32_t polygon = 0;          ///< Detour's reference
        Eigen::Vector3d position{0, 0, 0};  ///< world; its height is that of the mesh
    };

    /// The place on the mesh nearest to `p_world`; none within 2 m.
    std::optional<Place> nearest(const Eigen::Vector3d& p_world) const;

    /// Where one comes who goes straight from `from` to `p_world`, along the edges of the mesh
    /// where it ends. 1 us.
    Place slide(const Place& from, const Eigen::Vector3d& p_world) const;

    /// Is the straight way from `from` to `p_world` on the mesh all along, and nowhere on what is
    /// more road than `most` (sidewalk, crossing, road)? 1 us.
    bool is_clear(const Place& from,
                  const Eigen::Vector3d& p_world,
                  ground::Surface most = ground::Surface::road) const;

    ground::Surface surface(const Place& place) const;

    /// As above, between places on the mesh.
    std::optional<std::vector<Step>> path(const Place& from,
                                          const Place& to,
                                          const Costs& costs) const;
    std::optional<std::vector<Step>> path(const Place& from, const Place& to) const;

    std::size_t polygons() const;
    std::size_t bytes() const;
    world::Digest128 digest() const;

  private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

}  // namespace reprise::walkers
