#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "world/town_generated.h"

namespace reprise::render {

/// Which way each lane goes at each place: corners of its line are rounded, as wheels are turned
/// bit by bit.
class LaneHeadings {
  public:
    explicit LaneHeadings(const world::TownT& town);

    /// [rad] counter-clockwise from east; none where there is no such lane. `s` in metres along it;
    /// before its beginning as at it, and so behind its end.
    std::optional<double> at(std::uint32_t lane, double s) const;

  private:
    struct Knot {
        float s;        ///< [m] along the lane, of the middle of a piece of its line
        float heading;  ///< [rad] within half a turn of the knot before
    };

    std::vector<std::uint32_t> first_;  // knot of each lane, and behind the last one
    std::vector<Knot> knots_;
};

}  // namespace reprise::render
