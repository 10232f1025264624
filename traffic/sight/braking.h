#pragma once

#include <algorithm>
#include <cmath>

namespace reprise::traffic {

/// How a driver brakes for what is ahead.
struct Braking {
    static constexpr double reaction = 1;  ///< [s] as SUMO's tau
    static constexpr double least_gap =
        0.5;  ///< [m] for which everybody brakes as hard as it takes
    static constexpr double spare_braking = 1.1;  ///< on top of what it takes

    double speed = 0;        ///< [m/s]
    double comfortable = 0;  ///< [m/s^2]
    double hardest = 0;      ///< [m/s^2]
    double step = 0;         ///< [s]

    /// The speed from which a car still stops within `gap` metres of one that drives at `ahead` and
    /// brakes as hard. Krauss, "Microscopic Modeling of Traffic Flow", 1998, ch. 2.
    double safe_speed(double gap, double ahead) const {
        const double delay = comfortable * reaction;
        return -delay +
               std::sqrt(delay * delay + ahead * ahead + 2 * comfortable * std::max(gap, 0.0));
    }

    /// [m/s] in the next tick, for one at `distance` [m] that drives at `ahead` [m/s], to stop
    /// `gap` metres behind it. Who is surprised brakes as hard as it takes.
    double speed_before(double distance, double gap, double ahead) const {
        const double room = std::max(distance - least_gap, 0.1);
        const double needed = (speed * speed - ahead * ahead) / (2 * room);
        const double braking = std::clamp(spare_braking * needed, comfortable, hardest);
        return std::max({safe_speed(distance - gap, ahead), speed - braking * step, 0.0});
    }
};

}  // namespace reprise::traffic
