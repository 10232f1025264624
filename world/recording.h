#pragma once

#include <cstdint>
#include <string>

#include "world/digest.h"
#include "world/episode_generated.h"
#include "world/spawns.h"
#include "world/town_generated.h"

namespace reprise::world {

/// All that a run starts from: what a trace carries so that it can be verified and rendered alone.
struct Recording {
    EpisodeT episode;
    TownT town;
    std::string network;  ///< bytes of the SUMO network
};

/// How a run ended; written when the trace is closed.
struct Outcome {
    std::string verdict;  ///< "passed", "failed", "completed" (no checks); "error": cut off;
                          ///< "part": a slice that lacks the run's last tick; "driver_lost";
                          ///< "ended": from outside, while the scenario would go on
    std::string reason;   ///< as finish said it, "time limit", "scenario ended", "the trace was cut
                          ///< off", ...
    std::uint64_t ticks = 0;

    bool operator==(const Outcome&) const = default;
};

/// Of a trace that is the beginning of a run: it was cut off, and its end is lost.
Outcome outcome_of_cut_off(std::uint64_t ticks);

/// Of a run that ended because a driver in another program did; the scenario would go on.
Outcome outcome_of_lost_driver(const std::string& actor, std::uint64_t ticks);

/// Of an episode that its client ended, by beginning another one or by leaving with a goodbye.
Outcome outcome_of_ended_by_client(std::uint64_t ticks);

/// Of an episode that ended with the server that played it.
Outcome outcome_of_ended_by_server(std::uint64_t ticks);

/// Of a run that a driver in another program ended because it wanted to, such as a person who has
/// driven enough.
Outcome outcome_of_left_driver(const std::string& actor, std::uint64_t ticks);

/// Whether an outcome says that the run was ended while the scenario would go on, by a driver or
/// from outside: made again, it ends there as well.
bool is_early_end(const Outcome& outcome);

/// Of a slice without the run's last tick: how the run ended cannot be seen in it.
Outcome outcome_of_part(std::uint64_t ticks);

/// Where a part of a run begins.
struct SliceStart {
    std::uint64_t first = 1;      ///< its first tick
    std::uint64_t run_ticks = 0;  ///< how many the whole run had
    Digest128 chain_before{};     ///< the chain's value before that tick
    Spawns spawns{};              ///< of who was there before it: what they carry, and their names
};

/// The last tick that a run can have.
std::uint64_t tick_limit(const EpisodeT& episode);

/// Makes it end there; what would have branched off behind it is left out.
void limit_ticks(EpisodeT& episode, std::uint64_t ticks);

}  // namespace reprise::world
