#pragma once

#include <cstdint>
#include <functional>

#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// Does the driver of this vehicle want to get on? See Roster::is_under_way.
using UnderWay = std::function<bool(const world::VehicleState&)>;

/// Stage 6, behind measure: counts on, from `last`, for how many ticks each vehicle has been on its
/// way without moving, and says `blocked` once where that makes a minute (world/blockage.h): since
/// when, where, and who or what is ahead, where that is known. The count is in the tick, so that a
/// branch goes on with it.
void note_blockages(const world::TownT& town,
                    std::uint64_t step_ns,
                    const UnderWay& is_under_way,
                    const world::TickView& last,
                    world::TickDraft& next);

}  // namespace reprise::kernel
