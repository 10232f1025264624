#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ground/mesh/ground.h"
#include "world/geometry2d.h"

namespace reprise::ground {

/// Drops plumb lines on a ground mesh: where would a wheel rest? Built once, O(triangles near) for
/// each question.
class GroundProbe {
  public:
    /// Looks into `mesh`, which must outlive the probe.
    explicit GroundProbe(const GroundMesh& mesh);

    struct Hit {
        double z = 0;  ///< [m]
        Surface surface = Surface::terrain;
    };

    /// The highest ground at `from_world` or straight below it. Kerb faces, which have no area
    /// from above, painted lines and what holds bridges up do not count. None: a hole, or beyond
    /// the town's terrain.
    std::optional<Hit> below(const Eigen::Vector3d& from_world) const;

    /// What lies around a place, remembered from question to question of one who goes on in steps.
    struct Around {
        world::Box box{};
        std::span<const std::uint32_t> cell;   ///< of the grid, that the box counts in
        std::vector<std::uint32_t> triangles;  ///< that may be over a place in both
    };

    /// As that one, but asks the grid again only where `from_world` has left what is remembered.
    std::optional<Hit> below(const Eigen::Vector3d& from_world, Around& around) const;

    /// The ground of the level that a thing at `near_world` is on: of the levels that have headroom
    /// over them, the nearest one above or below. None: a hole, or beyond the town's terrain.
    std::optional<Hit> nearest(const Eigen::Vector3d& near_world) const;

    /// Triangles whose box in plan may touch `box`; some beside it, too. Ascending.
    std::vector<std::uint32_t> near(const world::Box& box) const { return by_place_.near(box); }

  private:
    /// In plan, of one triangle. [m] East and north of the world's origin.
    struct Extent {
        float west = 1;
        float south = 1;
        float east = -1;
        float north = -1;
    };

    std::optional<Hit> highest_of(std::span<const std::uint32_t> triangles,
                                  const Eigen::Vector3d& from_world) const;
    static Extent extent_of(const GroundMesh& mesh, std::size_t triangle);

    const GroundMesh* mesh_;
    std::vector<Extent> extents_;  ///< [triangle]
    world::BoxGrid by_place_;
};

}  // namespace reprise::ground
