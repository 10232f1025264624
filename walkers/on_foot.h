#pragma once

#include <cstdint>
#include <vector>

#include "world/tick.h"

namespace reprise::walkers {

/// What those on foot add to a tick. Apart from its draft: traffic writes there at the same time.
struct OnFoot {
    std::uint64_t tick = 0;                   ///< its index
    std::vector<world::WalkerState> walkers;  ///< by id
    std::vector<world::EventT> events;
};

}  // namespace reprise::walkers
