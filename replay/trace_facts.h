// Private to the room.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "replay/mcap/mcap.h"
#include "replay/recorded_tick.h"
#include "world/digest.h"
#include "world/recording.h"

namespace reprise::replay {

using Facts = std::map<std::string, std::string>;

/// Metadata reprise.run: all of it follows from the episode and what kind of trace this is. No
/// clock, no host, no path: equal runs give equal files.
Facts run_facts(const world::EpisodeT& episode,
                const world::Digest128& seed_of_chain,
                Level level,
                const std::optional<world::SliceStart>& slice);

/// Of a slice that begins behind the tick in which an actor was spawned: the command that did it,
/// with the actor's name, what it carries, who drives it. A line of reprise.run for each actor that
/// is there: slice.spawn.ACTOR = "TICK COMMAND", a world.Command in hexadecimal digits.
void add_spawns(const world::Spawns& spawns, Facts& facts);

/// Takes them from metadata of unknown origin, for a slice that begins at tick `first`. Answers
/// what is wrong, or nothing.
std::optional<std::string> take_spawns(const Facts& facts,
                                       std::uint64_t first,
                                       world::Spawns& spawns);

/// Metadata reprise.outcome. The digest of the episode's bytes covers the lines of the build and
/// the town's path, which the chain does not.
Facts outcome_facts(const world::Outcome& outcome,
                    const world::Digest128& last_chain,
                    mcap::View episode);

/// "seed is 99, where 7 was written": the first key in which they differ, or nothing. Without the
/// key "check".
std::optional<std::string> first_other_fact(const Facts& written, const Facts& found);

}  // namespace reprise::replay
