#include "replay/chain_seed.h"

#include "replay/trace_format.h"

namespace reprise::replay {

world::Digest128 chain_seed(const world::Recording& recording) {
    const world::EpisodeT& episode = recording.episode;
    world::Hasher hasher;
    hasher.add_text("reprise chain 1");
    hasher.add(episode.seed);
    hasher.add(episode.step_ns);
    hasher.add(episode.substeps);
    hasher.add(episode.max_ticks);
    hasher.add(episode.cars);
    hasher.add(episode.road_friction);
    hasher.add(episode.weather);
    hasher.add_text(episode.scenario);
    hasher.add(static_cast<std::uint64_t>(episode.parameters.size()));
    for (const world::ParameterT& parameter : episode.parameters) {
        hasher.add_text(parameter.key);
        hasher.add_text(parameter.value);
    }
    // Names and paths stay out: a copy of the same town under another path is the same world. The
    // fingerprint too: that another build gives the same run is what the chain is there to show.
    hasher.add(world::digest128(recording.network));
    const mcap::Bytes town = format::pack(recording.town);
    hasher.add(static_cast<std::uint64_t>(town.size()));
    hasher.add_bytes(town.data(), town.size());
    return hasher.digest128();
}

}  // namespace reprise::replay
