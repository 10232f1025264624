#pragma once

#include "world/recording.h"
#include "world/spawns.h"
#include "world/tick.h"

namespace reprise::world {

/// Which vehicles are driven by other programs, tick by tick.
class ExternalDrivers {
  public:
    /// The next tick of a run, as it was recorded whole.
    void hear(const Tick& tick);

    /// By actor: how the scenario spawned it.
    const Spawns& spawns() const { return spawns_; }

    /// Whether an outcome says that the driver of one of them was lost, or ended the run, which one
    /// cannot be seen in ticks; or that a client ended the episode, which is one of them; or the
    /// server, at any time.
    bool explain(const Outcome& outcome) const;

  private:
    Spawns spawns_;
};

}  // namespace reprise::world
