#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::walkers {

/// What the lights of the crossings say, and how long their green lasts: as somebody knows who has
/// seen it before.
class WalkerLights {
  public:
    /// `town` must outlive this.
    explicit WalkerLights(const world::TownT& town);

    /// As they were in the last tick; called for tick after tick.
    void look(const world::TickView& last);

    /// Signals of a crossing; none: not lit.
    std::vector<std::uint32_t> of_crossing(std::uint32_t lane) const;

    /// Is it green, and for a while longer?
    bool is_open(std::uint32_t signal) const;

    void add_to(world::Hasher& hasher) const;

  private:
    struct Light {
        std::uint32_t signal = 0;
        std::uint32_t crossing = 0;
        bool green = false;
        std::uint32_t age = 0;    ///< [ticks] of this green
        std::uint32_t usual = 0;  ///< [ticks] of the last whole green; 0: not seen yet
    };

    std::vector<Light> lights_;  ///< ascending by signal
};

}  // namespace reprise::walkers
