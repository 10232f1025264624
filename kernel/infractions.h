#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "replay/score/watch.h"
#include "world/spawns.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// Stage 6. Says what drivers of vehicles with mass do wrong, by the watches of `reprise score`:
/// red lights and stop signs that are run, opposite lanes, sidewalks, speeding, the wrong way, off
/// the road. Each is one event, when it begins; contacts and blockages have events of their own.
/// What the last tick shows is said in the next one, as checks are. Depends on the ticks and the
/// town alone.
class Infractions {
  public:
    Infractions(const world::TownT& town, double step) : town_(town), step_(step) {}

    void note(const world::TickView& last, world::TickDraft& next);

  private:
    struct Watched {
        replay::LastSeen seen;
        std::vector<std::unique_ptr<replay::Watch>> watches;
    };

    replay::DrivenTown town_;
    double step_;  ///< [s]
    world::Spawns spawns_;
    std::map<std::uint32_t, Watched> watched_;
};

}  // namespace reprise::kernel
