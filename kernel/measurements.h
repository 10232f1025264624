#pragma once

#include <span>

#include "kernel/physics/impact.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// Stage 6. Measures every vehicle of `next` (lane, speeds, footprint shares, gap, impulses added
/// to those of `last`; `impacts` are the tick's): a pure function of two ticks and the town.
void measure(const world::TownT& town,
             const world::LaneMap& lanes,
             double step_seconds,
             std::span<const Impact> impacts,
             const world::TickView& last,
             world::TickDraft& next);

}  // namespace reprise::kernel
