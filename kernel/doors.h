#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "world/digest.h"
#include "world/models/doors.h"
#include "world/tick.h"

namespace reprise::kernel {

/// The doors that the scenario opened (command set_doors): they swing at a person's pace, and stay.
class Doors {
  public:
    /// Carries out next's commands; who leaves takes its doors along.
    void apply_commands(const world::TickDraft& next);

    /// Moves every door by a tick and writes next.tick.doors: those that are not shut. [s]
    void swing(double step, world::TickDraft& next);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Order {
        std::uint8_t open = 0;                           ///< bit i: door i
        std::array<double, world::door_count> angles{};  ///< [rad]
    };

    std::map<std::uint32_t, Order> orders_;  ///< by actor
};

}  // namespace reprise::kernel
