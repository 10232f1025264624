#include "world/lanes/density.h"

#include <algorithm>

namespace reprise::world {

std::uint32_t cars_carried(const TownT& town) {
    // Ten minutes flowed in Town 2 (70 cars, five seeds) and in Town 1 (100, and this many, one
    // seed). The junctions of the proving ground are dense with it: a mean of 10 km/h in the tenth
    // minute.
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
