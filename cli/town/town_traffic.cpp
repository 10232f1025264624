#include "cli/town/town_traffic.h"

#include "cli/process/say.h"
#include "world/lanes/density.h"

namespace reprise::cli {

void tell_if_crowded(const world::EpisodeT& episode, const world::TownT& town) {
    const std::uint32_t carried = world::cars_carried(town);
    // What a town carries is known to a fifth: Town 2 flowed with 70 in all of five seeds.
    constexpr double surely_more = 1.2;
    if (static_cast<double>(episode.cars) > surely_more * carried)
        say(stderr,
            "{}: {} cars are more than {} carries, which is about {}: they may come to a "
            "standstill; cars = 'auto' asks for as many as flow\n",
            episode.scenario_path,
            episode.cars,
            town.name,
            carried);
}

}  // namespace reprise::cli
