#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "world/tick_generated.h"

namespace reprise::remote {

/// Which ticks a driver is shown: the one in which it takes its seat, and of all those in which its
/// vehicle is there each so many, counted from the one in which that was spawned, as the sensors of
/// its rig count.
struct Rhythm {
    std::uint64_t first = 0;  ///< tick in which the driver sits down
    std::uint64_t since = 0;  ///< tick in which the vehicle appeared
    std::uint64_t every = 1;  ///< [ticks]

    /// `step` [s] of a tick. What no scenario can have said is as near to it as can be.
    static Rhythm of(const world::CommandT& spawn,
                     std::uint64_t since,
                     std::uint64_t first,
                     double step) {
        constexpr double most = 100;  // [ticks]
        const double ticks = spawn.duration / step;
        return {first,
                since,
                ticks > 1 ? static_cast<std::uint64_t>(std::lround(std::min(ticks, most))) : 1};
    }

    bool shows(std::uint64_t tick) const { return tick == first || (tick - since) % every == 0; }

    /// The first one behind `tick` that it is shown.
    std::uint64_t next(std::uint64_t tick) const { return tick + every - (tick - since) % every; }
};

}  // namespace reprise::remote
