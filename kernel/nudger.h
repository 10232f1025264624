#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/drill/nudge.h"
#include "kernel/stage.h"
#include "world/tick.h"

namespace reprise::kernel {

class Pedestrians;
class Physics;
class Roster;

/// Carries a nudge out. After each stage of its tick it looks for the number in what the stage
/// wrote, and moves it there and in what the stage keeps behind it (a body's velocity, a walker's
/// unrounded position), so that the run really goes on from it. SUMO's cars are moved in the record
/// only, by units of the recorded number (whose last place is far below the grid that it was
/// rounded to): physics and drivers see it, SUMO drives them from its own state.
/// The control of a manual driver that the scenario leaves alone is an input: verify repeats it,
/// only diff can see it.
class Nudger {
  public:
    /// All three must outlive this.
    Nudger(Roster& roster, Pedestrians& pedestrians, Physics& physics)
        : roster_(&roster),
          pedestrians_(&pedestrians),
          physics_(&physics) {}

    void plan(Nudge nudge) { nudge_ = std::move(nudge); }

    /// To be called after each stage, before its digest. After the last one it throws world::Error
    /// when nothing in this tick was what the nudge asked for.
    void after(Stage stage, world::TickDraft& next);

  private:
    struct Row;

    bool is_due(const world::TickDraft& next);
    std::optional<std::uint32_t> wanted_actor() const;
    bool move_road_friction(world::TickDraft& next) const;
    bool move(const Row& row);
    void move_behind_the_record(Stage stage, const Row& row);
    std::string whereabouts(const world::TickDraft& next) const;
    static std::vector<Row> rows_of(Stage stage, world::TickDraft& next);

    Roster* roster_;
    Pedestrians* pedestrians_;
    Physics* physics_;
    std::optional<Nudge> nudge_;                  ///< until it is done
    std::map<std::uint32_t, std::string> names_;  ///< of actors that were spawned so far
};

}  // namespace reprise::kernel
