#pragma once

#include <cstdint>
#include <vector>

#include "towns/bridges/levels.h"

namespace reprise::towns {

/// Finds the bridge or tunnel that gave a place its height (an index into levels.spans, of which at
/// least one has points): of the raised points near the place, the span nearest along the roads;
/// where no point is raised, the span nearest in plan. Built in O(points), asked in O(points near).
class ResponsibleSpan {
  public:
    /// `heights` are those of the points of `roads`. [m] Looks into the first two.
    ResponsibleSpan(const RoadChains& roads,
                    const Levels& levels,
                    const std::vector<double>& heights);

    std::uint32_t at(const Eigen::Vector2d& place) const;

  private:
    const RoadChains& roads_;
    const Levels& levels_;
    std::vector<std::uint32_t> nearest_;  ///< span of each point; world::none far from all
    std::vector<double> distances_;       ///< [m] of each point to it
    world::BoxGrid raised_by_place_;      ///< points
};

}  // namespace reprise::towns
