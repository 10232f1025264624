#pragma once

#include <cstdint>
#include <vector>

#include "towns/bridges/levels.h"

namespace reprise::towns {

/// The bridge or tunnel (an index into levels.spans, of which one at least has points) whose ramps
/// are about a place: from its raised points there, the nearest along the roads. Where none is
/// raised, the nearest in plan.
class Blame {
  public:
    /// `heights` are those of the points of `roads`. [m] Looks into all three.
    Blame(const RoadChains& roads, const Levels& levels, const std::vector<double>& heights);

    std::uint32_t at(const Eigen::Vector2d& place) const;

  private:
    const RoadChains& roads_;
    const Levels& levels_;
    const std::vector<double>& heights_;
    std::vector<std::uint32_t> nearest_;  ///< span of each point; world::none far from all
    std::vector<double> distances_;       ///< [m] of each point to it
};

}  // namespace reprise::towns
