#pragma once

#include <cstdint>

#include "drivers/control/ego.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// Is there room for us on a neighbouring lane: nobody beside us, nobody so near or so fast behind
/// that he had to brake hard, nobody so near ahead that we had to?
bool is_clear(const world::TickView& last,
              const Ego& ego,
              const world::TownT& town,
              std::uint32_t lane);

}  // namespace reprise::drivers
