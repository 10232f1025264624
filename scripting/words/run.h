#pragma once

#include <optional>

#include "scripting/lua/vm.h"
#include "scripting/words/actors.h"
#include "scripting/words/checks.h"
#include "scripting/words/streams.h"
#include "scripting/words/tasks.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::scripting {

/// What the words of the vocabulary work on while a scenario runs.
struct Run {
    Run(Vm& machine, const world::EpisodeT& its_episode, const world::TownT& its_town)
        : vm(machine),
          episode(its_episode),
          town(its_town),
          step(static_cast<double>(its_episode.step_ns) * 1e-9),
          streams(its_episode.seed) {}

    Vm& vm;
    const world::EpisodeT& episode;
    const world::TownT& town;
    double step;  ///< [s]

    world::TickView last;              ///< what the scenario sees
    world::TickDraft* next = nullptr;  ///< where it speaks; null outside of a step

    Actors actors;
    Tasks tasks;
    Checks checks;
    Streams streams;
    bool finished = false;

    std::uint64_t now() const { return last.index(); }

    /// Adds a command, with the script's line.
    world::CommandT& say(lua_State* L, world::CommandKind kind, std::uint32_t actor);

    /// Ends the run: the tick's last command.
    void finish(const std::string& reason, std::uint32_t line);

    /// The lane of this name, or throws with a hint; a search for the hint is charged.
    std::uint32_t lane_named(lua_State* L, const std::string& name);

    /// The body with its lane, found by place where the tick does not name it. The actor must be
    /// present.
    Body look_at(const Actor& actor);

  private:
    std::optional<world::LaneMap> lanes_;  ///< built when first needed
};

}  // namespace reprise::scripting
