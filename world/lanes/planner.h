#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "world/lanes/route.h"
#include "world/town.h"

namespace reprise::world {

/// May a way change lanes?
enum class LaneChanges : std::uint8_t { allowed, forbidden };

/// Shortest ways over the lanes of a town, by A*. A pure function of the town: equal questions give
/// equal answers.
///
/// MUST    the least cost: metres driven, and 40 m for each change of lanes; 200 m where it and
///         those before it on the street, or before the goal, share less than 40 m each; 10 km
///         below 20 m, where a car may miss it. To turn around costs 1 km. Ties go to the lower
///         lane index.
/// ASSUMES that who is on a lane can change to a neighbour in the same direction anywhere on it.
/// GOES    over all lanes for cars, internal ones included, from the start of one to the start of
///         the next; the lanes beside the start are entered at its height. What is left is
///         estimated by the straight line to the goal, which no way undercuts.
/// KEEPS   nothing but the town.
class Planner {
  public:
    /// Looks into `town`, which must outlive the planner. Without changes of lanes a way follows
    /// the links only.
    explicit Planner(const TownT& town, LaneChanges changes = LaneChanges::allowed)
        : town_(&town),
          changes_(changes) {}

    /// The way from one place to another; none where no way leads. A goal behind the start on the
    /// same lane is reached around a block. Poses become places by LaneMap::best. Both lanes must
    /// be for cars; s is clamped to the lane. O(n log n) at worst; Town 1: 0.02 ms on average.
    std::optional<Route> plan(LanePlace from, LanePlace to) const;

    /// [m] of plan(from, to) and what its changes of lanes cost; none where no way leads.
    std::optional<double> cost(LanePlace from, LanePlace to) const;

  private:
    const TownT* town_;
    LaneChanges changes_;
};

}  // namespace reprise::world
