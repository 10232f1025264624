#pragma once

#include <cstdint>
#include <map>

#include "world/digest.h"
#include "world/tick.h"

namespace reprise::kernel {

/// Lamps that the scenario has taken from an actor's driver (command set_lamps), whoever moves it.
class LampOrders {
  public:
    /// Carries out next's commands; who leaves is forgotten.
    void apply_commands(const world::TickDraft& next);

    /// The lamps of next's cars, behind the traffic stage; of its vehicles, behind physics.
    void light_cars(world::TickDraft& next) const;
    void light_vehicles(world::TickDraft& next) const;

    void add_to(world::Hasher& hasher) const;

  private:
    struct Order {
        std::uint16_t lamps = 0;
        std::uint16_t mask = 0;  ///< the bits that the scenario decides
    };

    template <typename Actors>
    void light(Actors& actors) const;

    std::map<std::uint32_t, Order> orders_;  ///< by actor
};

}  // namespace reprise::kernel
