#pragma once

#include <cstdint>
#include <vector>

#include "ground/paint/paint.h"
#include "world/town_generated.h"

namespace reprise::ground {

/// The line across the end of a lane: a stop line before a signal or a stop sign, a row of
/// triangles that point at the driver ("shark's teeth", Vienna Convention on Road Signs, annex 8)
/// where every way on must yield to another road. Nothing where nobody has priority: such junctions
/// carry no lines.
class StopLines {
  public:
    /// Looks into `town`, which must outlive it.
    explicit StopLines(const world::TownT& town);

    /// `centre` is the lane's clean line.
    void paint(std::uint32_t lane, const Line& centre, Paint& paint) const;

  private:
    enum class Kind { none, stop, give_way };

    Kind kind_of(std::uint32_t lane) const;

    const world::TownT* town_;
    std::vector<bool> has_stop_sign_;      ///< by lane
    std::vector<bool> has_priority_road_;  ///< by junction: does somebody not have to yield?
};

}  // namespace reprise::ground
