#pragma once

#include <cstdint>
#include <map>

#include "world/recording.h"
#include "world/tick.h"

namespace reprise::world {

/// Which vehicles are driven by other programs, tick by tick.
class ExternalDrivers {
  public:
    /// The next tick of a run, as it was recorded whole.
    void hear(const Tick& tick);

    struct Spawn {
        CommandT command;        ///< as the scenario said it
        std::uint64_t tick = 0;  ///< in which it did
    };

    /// By actor: how the scenario spawned it.
    const std::map<std::uint32_t, Spawn>& spawns() const { return spawns_; }

    /// Whether an outcome says that the driver of one of them was lost, or ended the run, which one
    /// cannot be seen in ticks; or that a client ended the episode, which is one of them; or the
    /// server, at any time.
    bool explain(const Outcome& outcome) const;

  private:
    std::map<std::uint32_t, Spawn> spawns_;
};

}  // namespace reprise::world
