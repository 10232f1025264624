#pragma once

#include <vector>

#include <Eigen/Core>

#include "towns/check/criterion.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// What a town promises about its lanes for cars, as they are drawn: at most 0.5 % of their length
/// between junctions lies under a lane of another road at the same height (roads that meet are
/// free to touch near their junction, and both directions may share one lane); none is drawn more
/// than 1.25 times as long as SUMO counts it, or the other way round; none folds back over itself
/// (sharpest_turn). O(lanes near).
std::vector<Criterion> check_lanes(const world::TownT& town);

/// [rad] A line may turn by so much at one point: a V. Beyond it, it folds back.
inline constexpr double sharpest_turn = 150.0 / 180.0 * 3.14159265358979323846;

/// [rad] by which a line turns at its point `i`, not the first nor last: 0 to pi.
double turn_at(const std::vector<Eigen::Vector2d>& line, std::size_t i);

}  // namespace reprise::towns
