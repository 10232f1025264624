#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scripting/lua/vm.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::scripting {

/// What a scenario sees and where it speaks: the episode, the last tick and the draft of the next.
struct StepContext {
    StepContext(Vm& machine, const world::EpisodeT& its_episode, const world::TownT& its_town)
        : vm(machine),
          episode(its_episode),
          town(its_town),
          step(static_cast<double>(its_episode.step_ns) * 1e-9) {}

    Vm& vm;
    const world::EpisodeT& episode;
    const world::TownT& town;
    double step;  ///< [s]

    world::TickView last;              ///< what the scenario sees
    world::TickDraft* next = nullptr;  ///< where it speaks; null outside of a step
    bool finished = false;             ///< the run ends with the next tick
    std::size_t printed_in_tick = 0;   ///< [bytes]
    std::size_t printed = 0;           ///< [bytes] since the script began

    /// What the script says from now on goes there; null: nowhere.
    void speak_into(world::TickDraft* draft) {
        next = draft;
        printed_in_tick = 0;
    }

    std::uint64_t now() const { return last.index(); }

    /// Adds a command, with the script's line.
    world::CommandT& say(lua_State* L, world::CommandKind kind, std::uint32_t actor);

    /// Ends the run: the tick's last command.
    void finish(const std::string& reason, std::uint32_t line);
};

}  // namespace reprise::scripting
