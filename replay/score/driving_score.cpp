#include "replay/score/driving_score.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reprise::replay {

namespace {

constexpr double one_place = 5;  // [m]
constexpr double one_time = 5;   // [s]

struct Coefficients {
    const char* what;
    std::uint64_t LeaderboardCounts::*count;
    double factor;  ///< 1.0, 2.0
    double term;    ///< 2.1
};

constexpr std::array<Coefficients, 5> coefficients{{
    {"pedestrian", &LeaderboardCounts::pedestrians, 0.50, 1.0},
    {"vehicle", &LeaderboardCounts::vehicles, 0.60, 0.7},
    {"fixed thing", &LeaderboardCounts::fixed, 0.65, 0.6},
    {"red light", &LeaderboardCounts::red_lights, 0.70, 0.4},
    {"stop sign", &LeaderboardCounts::stop_signs, 0.80, 0.25},
}};

/// As CollisionTest of CARLA's scenario runner: whoever is hit within 5 m of where the last one
/// was, and who was hit last for 5 s wherever that is. Something fixed has no name to know again.
bool is_same_collision(const Infraction& counted,
                       const Infraction& infraction,
                       std::uint64_t step_ns) {
    const double later = static_cast<double>((infraction.first - counted.first) * step_ns) * 1e-9;
    return (infraction.position - counted.position).norm() <= one_place ||
           (infraction.other != 0 && infraction.other == counted.other && later <= one_time);
}

}  // namespace

LeaderboardCounts leaderboard_counts(const VehicleScore& vehicle, std::uint64_t step_ns) {
    LeaderboardCounts counts;
    const double driven = vehicle.ended ? vehicle.ended->driven : vehicle.driven;
    const double off_lane = vehicle.ended ? vehicle.ended->off_lane : vehicle.off_lane;
    counts.off_lane = driven > 0 ? off_lane / driven : 0;
    const Infraction* counted = nullptr;  // the collision that was counted last, with anybody
    for (const Infraction& infraction : vehicle.infractions) {
        if (vehicle.ended && infraction.first > vehicle.ended->tick)
            continue;
        std::uint64_t* count = nullptr;
        switch (infraction.kind) {
            case InfractionKind::collision_vehicle:
                count = &counts.vehicles;
                break;
            case InfractionKind::collision_pedestrian:
                count = &counts.pedestrians;
                break;
            case InfractionKind::collision_static:
                count = &counts.fixed;
                break;
            case InfractionKind::red_light:
                ++counts.red_lights;
                break;
            case InfractionKind::stop_sign:
                ++counts.stop_signs;
                break;
            default:
                break;
        }
        if (count == nullptr)
            continue;
        if (counted != nullptr && is_same_collision(*counted, infraction, step_ns))
            continue;
        counted = &infraction;
        ++*count;
    }
    return counts;
}

DrivingScore driving_score(Leaderboard leaderboard,
                           const LeaderboardCounts& counts,
                           std::optional<double> completion) {
    DrivingScore result;
    result.off_lane = counts.off_lane;
    double sum = 0;
    for (const Coefficients& row : coefficients) {
        DrivingScore::Factor factor;
        factor.what = row.what;
        factor.count = counts.*row.count;
        const auto times = static_cast<double>(factor.count);
        if (leaderboard == Leaderboard::multiplicative) {
            factor.each = row.factor;
            factor.value = std::pow(row.factor, times);
            result.penalty *= factor.value;
        } else {
            factor.each = row.term;
            factor.value = row.term * times;
            sum += factor.value;
        }
        result.factors.push_back(factor);
    }
    const double on_lane = 1 - counts.off_lane;
    if (leaderboard == Leaderboard::additive)
        result.penalty = on_lane / (1 + sum);
    if (!completion)
        return result;
    result.completion = *completion;
    if (leaderboard == Leaderboard::multiplicative)
        *result.completion *= on_lane;
    result.score = 100 * *result.completion * result.penalty;
    return result;
}

}  // namespace reprise::replay
