#pragma once

#include <memory>
#include <optional>

#include "towns/furnish/clearance.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Heights of the ground under a town's buildings, plants and furniture: those of
/// ground::build_ground, which wheels roll on and cameras see. Where all lanes lie at one height
/// there is nothing to look up, and nothing is built.
class GroundHeights {
  public:
    /// The town needs its lanes, links, junctions and box. As long as build_ground takes.
    explicit GroundHeights(const world::TownT& town);
    ~GroundHeights();

    /// Do all lanes lie at one height?
    bool is_level() const { return hills_ == nullptr; }

    /// The ground at `p` of the level that is nearest to height `near`; in a level town `near`.
    /// None: beyond the terrain. [m]
    std::optional<double> at(const Eigen::Vector2d& p, double near) const;

    /// Lowest and highest ground. [m]
    struct Span {
        double low = 0;
        double high = 0;

        double rise() const { return high - low; }
    };

    /// As at(), under a whole footprint: tried every two metres and at its border. None: a part of
    /// it is beyond the terrain.
    std::optional<Span> under(const Footprint& footprint, double near) const;

  private:
    struct Hills;
    std::unique_ptr<const Hills> hills_;
};

}  // namespace reprise::towns
