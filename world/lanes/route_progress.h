#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "world/lanes/planner.h"
#include "world/lanes/route.h"

namespace reprise::world {

/// The shortest way over these stops in their order: lanes to pass, the last one at `last_s`; the
/// first one is passed already where one stands on it and there are others. None where no way
/// leads. As Planner::plan for each stop.
std::optional<Route> plan_over(const Planner& planner,
                               LanePlace from,
                               std::span<const std::uint32_t> stops,
                               double last_s);

/// How much of a way has been driven. Only what is driven counts: on it, or on a lane beside it.
/// Who leaves it and comes back farther on has come no farther than it drove meanwhile.
class RouteProgress {
  public:
    explicit RouteProgress(Route route) : route_(std::move(route)) {}

    /// Where the rear axle is at the next tick, if on a lane; `driven`: [m] since the last one;
    /// `front`: [m] to the front bumper. O(pieces passed).
    void drive_on(const TownT& town, std::optional<LanePlace> place, double driven, double front);

    /// What is to come, from the piece on that was driven last.
    std::span<const Route::Piece> to_come() const {
        return std::span(route_.pieces).subspan(std::min(piece_, route_.pieces.size()));
    }

    /// In [0, 1], never less than before; 1 once the front bumper was at the goal.
    double share() const;

  private:
    Route route_;
    std::size_t piece_ = 0;  ///< that was driven last
    double along_ = 0;       ///< [m]
    double beside_ = 0;      ///< [m] driven since it was on the way
    bool arrived_ = false;
};

}  // namespace reprise::world
