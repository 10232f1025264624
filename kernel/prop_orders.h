#pragma once

#include "kernel/physics/physics.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// Carries out next's commands for props: puts them on their places, and takes them away. Writes
/// spawned and despawned events.
void place_props(const world::TownT& town, world::TickDraft& next, Physics& physics);

}  // namespace reprise::kernel
