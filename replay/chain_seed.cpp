#include "replay/chain_seed.h"

#include "replay/trace_format.h"

namespace reprise::replay {

namespace {

void add_parameters(world::Hasher& hasher, const std::vector<world::ParameterT>& parameters) {
    hasher.add(static_cast<std::uint64_t>(parameters.size()));
    for (const world::ParameterT& parameter : parameters) {
        hasher.add_text(parameter.key);
        hasher.add_text(parameter.value);
    }
}

/// Few runs have any: without one the chain is what it was.
void add_files(world::Hasher& hasher, const std::vector<world::FileT>& files) {
    if (files.empty())
        return;
    hasher.add_text("files");
    hasher.add(static_cast<std::uint64_t>(files.size()));
    for (const world::FileT& file : files) {
        hasher.add_text(file.name);
        hasher.add_text(file.text);
    }
}

}  // namespace

world::Digest128 chain_seed(const world::Recording& recording) {
    const world::EpisodeT& episode = recording.episode;
    world::Hasher hasher;
    hasher.add_text("reprise chain 2");
    hasher.add(episode.seed);
    hasher.add(episode.step_ns);
    hasher.add(episode.substeps);
    hasher.add(episode.max_ticks);
    hasher.add(episode.cars);
    if (episode.walkers != 0 || episode.walker_seed != 0 || episode.jaywalkers != 0) {
        hasher.add_text("walkers");
        hasher.add(episode.walkers);
        hasher.add(episode.walker_seed);
        hasher.add(episode.jaywalkers);
    }
    hasher.add(episode.road_friction);
    hasher.add(episode.weather);
    hasher.add_text(episode.weather_name);
    // Names, too: a script's errors name its file, and a script can read them.
    hasher.add_text(episode.name);
    hasher.add_text(episode.scenario_path);
    hasher.add_text(episode.scenario);
    add_parameters(hasher, episode.parameters);
    add_files(hasher, episode.files);
    hasher.add_text(episode.imported_from);
    hasher.add_text(episode.town);
    hasher.add(episode.town_digest);
    hasher.add(world::digest128(recording.network));
    const mcap::Bytes town = format::pack(recording.town);
    hasher.add(static_cast<std::uint64_t>(town.size()));
    hasher.add_bytes(town.data(), town.size());
    return hasher.digest128();
}

world::Digest128 chain_of_branch(const world::Digest128& parent, const world::BranchT& branch) {
    world::Hasher hasher;
    hasher.add_text("reprise branch 1");
    hasher.add(branch.tick);
    hasher.add_text(branch.name);
    hasher.add_text(branch.scenario_path);
    hasher.add_text(branch.scenario);
    add_parameters(hasher, branch.parameters);
    hasher.add(branch.max_ticks);
    hasher.add(branch.parent_chain);
    add_files(hasher, branch.files);
    return world::chain(parent, hasher.digest128());
}

world::Digest128 chain_before(const world::EpisodeT& episode,
                              std::uint64_t index,
                              const world::Digest128& last) {
    world::Digest128 chain = last;
    for (const world::BranchT& branch : episode.branches)
        if (branch.tick + 1 == index)
            chain = chain_of_branch(chain, branch);
    return chain;
}

}  // namespace reprise::replay
