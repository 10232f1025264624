#include "world/recording.h"

namespace reprise::world {

Outcome outcome_of_cut_off(std::uint64_t ticks) {
    return {"error", "the trace was cut off", ticks};
}

Outcome outcome_of_lost_driver(const std::string& actor, std::uint64_t ticks) {
    return {"driver_lost", "the driver of '" + actor + "' was lost", ticks};
}

Outcome outcome_of_ended_by_client(std::uint64_t ticks) {
    return {"ended", "by its client", ticks};
}

Outcome outcome_of_ended_by_server(std::uint64_t ticks) {
    return {"ended", "by its server", ticks};
}

Outcome outcome_of_left_driver(const std::string& actor, std::uint64_t ticks) {
    return {"ended", "by the driver of '" + actor + "'", ticks};
}

bool is_early_end(const Outcome& outcome) {
    return outcome.verdict == "driver_lost" ||
           outcome == outcome_of_ended_by_client(outcome.ticks) ||
           outcome == outcome_of_ended_by_server(outcome.ticks) ||
           (outcome.verdict == "ended" && outcome.reason.starts_with("by the driver of '"));
}

Outcome outcome_of_part(std::uint64_t ticks) {
    return {"part", "a slice without the run's end", ticks};
}

std::uint64_t tick_limit(const EpisodeT& episode) {
    return episode.branches.empty() ? episode.max_ticks : episode.branches.back().max_ticks;
}

void limit_ticks(EpisodeT& episode, std::uint64_t ticks) {
    while (!episode.branches.empty() && episode.branches.back().tick >= ticks)
        episode.branches.pop_back();
    (episode.branches.empty() ? episode.max_ticks : episode.branches.back().max_ticks) = ticks;
}

}  // namespace reprise::world
