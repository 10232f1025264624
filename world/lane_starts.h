#pragma once

#include <vector>

#include "world/town.h"

namespace reprise::world {

/// Where the segments of a lane's centre line begin, for who asks for many of its points: point_at
/// walks to each of them anew. Kept for long lines only: short ones are walked, as always.
class LaneStarts {
  public:
    explicit LaneStarts(const LaneT& lane);

    /// As point_at(lane, s), of the same lane.
    LanePoint at(const LaneT& lane, double s) const;

  private:
    std::vector<double> starts_;  ///< [m] of each segment; empty: the line is short
};

}  // namespace reprise::world
