#pragma once

#include <cstdint>

#include "drivers/way/way.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// Does somebody long turn, over the junction behind the gate, into the street that we come from? A
/// bus or a lorry needs more than its lane for that, and most of all the place of who waits at the
/// line. `self`: who asks.
bool turns_in_beside(const world::TickView& last,
                     const world::TownT& town,
                     const Gate& gate,
                     std::uint32_t self);

}  // namespace reprise::drivers
