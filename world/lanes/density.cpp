#include "world/lanes/density.h"

#include <algorithm>

namespace reprise::world {

std::uint32_t cars_carried(const TownT& town) {
    // Measured in Town 1, Town 2 and the proving ground over ten minutes of five seeds each.
    constexpr double cars_per_metre = 0.035;
    constexpr double most = 10'000;  // that a header may ask for
    double length = 0;
    for (const LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::driving)
            length += lane.length;
    return static_cast<std::uint32_t>(std::min(most, length * cars_per_metre));
}

void settle_cars(EpisodeT& episode, const TownT& town) {
    if (episode.cars == auto_cars)
        episode.cars = cars_carried(town);
}

}  // namespace reprise::world
