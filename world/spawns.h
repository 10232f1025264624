#pragma once

#include <cstdint>
#include <map>

#include "world/tick_generated.h"

namespace reprise::world {

/// How an actor came into the world.
struct Spawn {
    CommandT command;        ///< as the scenario said it
    std::uint64_t tick = 0;  ///< in which it did
};

/// By actor.
using Spawns = std::map<std::uint32_t, Spawn>;

/// The next tick of a run: who is spawned in it is among them from now on, who is despawned no
/// longer.
void hear_spawns(const Tick& tick, Spawns& spawns);

}  // namespace reprise::world
