#include "cli/town/town_traffic.h"

#include "cli/process/say.h"
#include "world/lanes/density.h"

namespace reprise::cli {

void tell_if_crowded(const world::EpisodeT& episode, const world::TownT& town) {
    const std::uint32_t carried = world::cars_carried(town);
    if (episode.cars > carried)
        say(stderr,
            "{}: {} cars are more than {} carries, which is about {}: they may come to a "
            "standstill; cars = 'auto' asks for as many as flow\n",
            episode.scenario_path,
            episode.cars,
            town.name,
            carried);
}

}  // namespace reprise::cli
