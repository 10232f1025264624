#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scripting/run/actors.h"
#include "scripting/run/checks.h"
#include "scripting/run/measures.h"
#include "scripting/run/step_context.h"
#include "scripting/run/streams.h"
#include "scripting/run/surroundings.h"
#include "scripting/run/tasks.h"
#include "scripting/run/weathers.h"
#include "world/episode_generated.h"
#include "world/lanes/junctions.h"
#include "world/lanes/stop_lines.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::scripting {

/// What the words of the vocabulary work on while a scenario runs.
struct Run : StepContext {
    Run(Vm& machine,
        const world::EpisodeT& its_episode,
        const world::TownT& its_town,
        const world::LaneMap& its_lanes)
        : StepContext(machine, its_episode, its_town),
          lanes(its_lanes),
          stop_lines(its_town),
          streams(its_episode.seed) {}

    const world::LaneMap& lanes;
    world::StopLines stop_lines;
    Actors actors;
    Tasks tasks;
    Checks checks;
    Streams streams;
    Weathers weathers;

    /// The lane of this name, or throws with a hint; a search for the hint is charged.
    std::uint32_t lane_named(lua_State* L, const std::string& name);

    /// The body with its lane, found by place where the tick does not name it. The actor must be
    /// present.
    Body look_at(const Actor& actor);
    Body with_lane(const Body& body, bool is_walker);

    /// Of two actors who are present. Several tasks and checks ask for the same: searched once a
    /// tick.
    Gap gap(const Actor& a, const Actor& b);

    /// Likewise who is in the way of one of them, within so many metres.
    std::optional<InTheWay> in_the_way(const Actor& actor, double range);

    void forget_way(const Actor& actor) { in_the_way_.erase(actor.id); }

    /// Takes in the last tick: what became of the actors.
    void observe();

    /// Who is on the road in the last tick; made once a tick, when somebody asks.
    const std::vector<Neighbour>& everybody();

    /// Of the town; made when somebody asks.
    const std::vector<std::vector<world::JunctionArm>>& junction_arms();
    const std::vector<world::CrossingPlace>& crossings();

  private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, Gap> gaps_;  ///< of this tick, by ids
    std::uint64_t gaps_at_ = 0;                                    ///< tick
    std::map<std::uint32_t, std::optional<InTheWay>> in_the_way_;  ///< likewise
    std::uint64_t in_the_way_at_ = 0;                              ///< tick
    std::vector<Neighbour> everybody_;
    std::optional<std::uint64_t> everybody_at_;  ///< tick
    std::optional<std::vector<std::vector<world::JunctionArm>>> arms_;
    std::optional<std::vector<world::CrossingPlace>> crossings_;
};

}  // namespace reprise::scripting
