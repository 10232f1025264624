#include "world/recording.h"

namespace reprise::world {

std::uint64_t tick_limit(const EpisodeT& episode) {
    return episode.branches.empty() ? episode.max_ticks : episode.branches.back().max_ticks;
}

void limit_ticks(EpisodeT& episode, std::uint64_t ticks) {
    while (!episode.branches.empty() && episode.branches.back().tick >= ticks)
        episode.branches.pop_back();
    (episode.branches.empty() ? episode.max_ticks : episode.branches.back().max_ticks) = ticks;
}

}  // namespace reprise::world
