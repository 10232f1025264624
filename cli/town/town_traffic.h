#pragma once

#include "world/episode_generated.h"
#include "world/town_generated.h"

namespace reprise::cli {

/// Says on stderr when a run asks for more cars than its town carries. It goes on: jams are a test
/// as well.
void tell_if_crowded(const world::EpisodeT& episode, const world::TownT& town);

}  // namespace reprise::cli
