#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// The colours of the town's signals, as SUMO's traffic light programs show them.
class SignalPrograms {
  public:
    /// Asks SUMO, which runs by now, which programs it knows. `town` must outlive this.
    explicit SignalPrograms(const world::TownT& town);

    /// Reads what changed in SUMO's step, and writes next.tick.signals.
    void read(world::TickDraft& next);

    void add_to(world::Hasher& hasher) const;

  private:
    /// A program of SUMO's and the signals that it switches.
    struct Program {
        std::string name;
        std::size_t first = 0;  ///< in Town.signals
        std::size_t count = 0;
        std::string state;  ///< as last read
    };

    const world::TownT* town_;
    std::vector<Program> programs_;
    std::vector<world::SignalColor> colors_;  ///< one for each of Town.signals
};

}  // namespace reprise::traffic
