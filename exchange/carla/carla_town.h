#pragma once

#include <cstdint>
#include <vector>

#include "exchange/carla/carla_survey.h"
#include "world/town_generated.h"

namespace reprise::exchange {

/// A plain at the height of the ground that was driven on, 50 m wider than that: one lane, of a
/// kind that nobody drives on, as wide as all of it.
world::TownT plain_town(const CarlaSurvey& survey);

/// For each of the town's signals the traffic light of the log that hangs for the same place, or 0:
/// the nearest one whose trigger lies within 12 m of the stop line; where the log holds no
/// triggers, whose pole stands within 40 m. `offset`: [m] of the town's origin to CARLA's.
std::vector<std::uint32_t> match_signals(const world::TownT& town,
                                         const CarlaSurvey& survey,
                                         const Eigen::Vector3d& offset);

}  // namespace reprise::exchange
