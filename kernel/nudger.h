#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "kernel/drill/nudge.h"
#include "world/tick.h"

namespace reprise::kernel {

class Pedestrians;
class Physics;
class Roster;

/// Carries a nudge out. After each stage of its tick it looks for the number in what the stage
/// wrote, and moves it there and in what the stage keeps behind it (a body's velocity, a walker's
/// unrounded place), so that the run really goes on from it. SUMO's cars are moved in the record
/// only, by units of the recorded number (whose last place is far below the grid that it was
/// rounded to): physics and drivers see it, SUMO drives them from what it believes itself.
/// The control of a manual driver that the scenario leaves alone is an input: verify repeats it,
/// only diff can see it.
class Nudger {
  public:
    void plan(Nudge nudge) { nudge_ = std::move(nudge); }

    void after_scenario(world::TickDraft& next);
    void after_controls(world::TickDraft& next, Roster& roster);
    void after_traffic(world::TickDraft& next);
    void after_pedestrians(world::TickDraft& next, Pedestrians& pedestrians);
    void after_physics(world::TickDraft& next, Physics& physics);

    /// The last one: throws world::Error when nothing in this tick was what the nudge asked for.
    void after_measurements(world::TickDraft& next);

  private:
    struct Row;

    bool is_due(const world::TickDraft& next);
    std::optional<std::uint32_t> wanted_actor() const;
    bool move(const Row& row);
    std::string whereabouts(const world::TickDraft& next) const;

    std::optional<Nudge> nudge_;                  ///< until it is done
    std::map<std::uint32_t, std::string> names_;  ///< of actors that were spawned so far
};

}  // namespace reprise::kernel
