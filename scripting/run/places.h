#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world/town.h"

namespace reprise::scripting {

/// Lanes any of which will do; ascending.
using StopLanes = std::vector<std::uint32_t>;

/// What a scenario asks of a lane. Unset: any.
struct LaneWish {
    double length = 0;         ///< [m] at least
    std::optional<bool> left;  ///< a neighbour in the same direction
    std::optional<bool> right;
    std::optional<bool> sidewalk;       ///< directly to its right
    std::optional<bool> straight;       ///< no bend tighter than 500 m
    std::optional<std::int64_t> lanes;  ///< of its edge, for cars
};

/// The driving lanes that fit and lead on, ascending. O(lanes).
std::vector<std::uint32_t> fitting_lanes(const world::TownT& town, const LaneWish& wish);

/// "length = 120.0, left = true"; empty for a wish that any lane fulfils.
std::string describe(const LaneWish& wish);

/// "'b2_m1_0' is a sidewalk, no lane for cars; beside it lies 'b2_m1_1' (driving)".
std::string not_for_cars(const world::TownT& town, const world::LaneT& lane);

/// The lane of this name, or throws: "no lane 'b1_b2_9' in town1 (did you mean 'b1_b2_1'?)".
std::uint32_t lane_named(const world::TownT& town, const std::string& name);

/// A stop of a route: a lane by its name, or an edge by its name, all lanes for cars of it from the
/// right.
StopLanes stop_named(const world::TownT& town, const std::string& name);

/// A place beside the road, opposite a point: across all lanes of both directions, and one metre
/// on.
Eigen::Vector3d across_road(const world::TownT& town,
                            std::uint32_t lane,
                            const Eigen::Vector3d& p_world);

}  // namespace reprise::scripting
