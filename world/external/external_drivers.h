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
    /// cannot be seen in ticks; or that a client or the server ended the episode, at any time: a
    /// client's vehicles may be still to come, or taken away.
    bool explain(const Outcome& outcome) const;

  private:
    Spawns spawns_;
};

}  // namespace reprise::world
