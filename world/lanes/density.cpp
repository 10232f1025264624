#include "world/lanes/density.h"

#include <algorithm>

#include "world/town.h"

namespace reprise::world {

namespace {

/// Of the ways on from the lane's end: those that must give way, and have no light. In [0, 1].
double yielding_share(const LaneT& lane) {
    if (lane.links.empty())
        return 0;
    const auto yielding = std::count_if(lane.links.begin(), lane.links.end(), [](const Link& link) {
        return link.yields() && link.signal() == none;
    });
    return static_cast<double>(yielding) / static_cast<double>(lane.links.size());
}

}  // namespace

std::uint32_t cars_carried(const TownT& town) {
    // Ten minutes flowed in Town 2 (70 cars, five seeds) and in Town 1 (100, and this many, one
    // seed). A lane whose cars must find gaps in the others' flow at its end, without lights, lets
    // half as many through: with as many on it as on the others the proving ground's grid of
    // junctions stood, from the fourth minute on (42 % of its cars, a mean of 9 km/h).
    constexpr double cars_per_metre = 0.035;
    constexpr double where_all_yield = 0.5;
    constexpr double most = 10'000;  // that a header may ask for
    double length = 0;
    for (const LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::driving)
            length += lane.length * (1 - (1 - where_all_yield) * yielding_share(lane));
    return static_cast<std::uint32_t>(std::min(most, length * cars_per_metre));
}

void settle_cars(EpisodeT& episode, const TownT& town) {
    if (episode.cars == auto_cars)
        episode.cars = cars_carried(town);
}

}  // namespace reprise::world
