#pragma once

#include <cstdint>

#include "world/episode_generated.h"
#include "world/town_generated.h"

namespace reprise::world {

/// Episode.cars of a scenario that says 'auto', until its town is known.
constexpr std::uint32_t auto_cars = 0xffffffff;

/// So many background cars a town can carry: with more, queues reach back from junction to junction
/// until they close a circle, in which nobody moves. By the length of its lanes for cars between
/// junctions, and by what their ends let through.
std::uint32_t cars_carried(const TownT& town);

/// Puts that number in the place of auto_cars.
void settle_cars(EpisodeT& episode, const TownT& town);

}  // namespace reprise::world
