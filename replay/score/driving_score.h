#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/score/score.h"

namespace reprise::replay {

/// What the Leaderboard counts: nothing lasts, and a collision within 5 m of the last one that
/// counted, or with the same one within 5 s of it, is that one. Until the route ended.
struct LeaderboardCounts {
    std::uint64_t vehicles = 0;
    std::uint64_t pedestrians = 0;
    std::uint64_t fixed = 0;
    std::uint64_t red_lights = 0;
    std::uint64_t stop_signs = 0;
    double off_lane = 0;  ///< share of what was driven, in [0, 1]
};

LeaderboardCounts leaderboard_counts(const VehicleScore& vehicle, std::uint64_t step_ns);

enum class Leaderboard : std::uint8_t { multiplicative, additive };

/// A driving score with all that it is made of.
struct DrivingScore {
    struct Factor {
        std::string what;  ///< "pedestrian"
        std::uint64_t count = 0;
        double each = 0;  ///< the coefficient of one
        double value =
            1;  ///< what all of them make: a factor (1.0, 2.0), or a term of the sum (2.1)
    };

    std::vector<Factor> factors;
    double off_lane = 0;  ///< share that is taken off: of the completion (1.0, 2.0), of all (2.1)
    double penalty = 1;   ///< the infractions'
    std::optional<double> completion;  ///< of the route as it counts, in [0, 1]; none: no route
    std::optional<double> score;       ///< in [0, 100]; none: no route
};

/// Leaderboard 1.0 and 2.0: completion x (1 - off_lane) x the product of coefficient^count, with
/// .50 for a pedestrian, .60 a vehicle, .65 something fixed, .70 a red light, .80 a stop sign.
/// Leaderboard 2.1: completion x (1 - off_lane) / (1 + the sum of coefficient * count), with 1.0,
/// .7, .6, .4 and .25. What no trace tells, a scenario's time limit, yielding to emergency vehicles
/// and the least speed, is left out: it takes nothing off. `completion` in [0, 1], as
/// RouteScore::counted() says it.
DrivingScore driving_score(Leaderboard leaderboard,
                           const LeaderboardCounts& counts,
                           std::optional<double> completion);

}  // namespace reprise::replay
