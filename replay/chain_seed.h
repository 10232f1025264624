#pragma once

#include "world/digest.h"
#include "world/recording.h"

namespace reprise::replay {

/// The chain's value before tick 1: of everything that the recording says about the run; what
/// branches off does not count yet. Left out: the build, because that another build gives the same
/// run is what the chain is there to show; and where the town's file lay.
world::Digest128 chain_seed(const world::Recording& recording);

/// What the first tick of a branch continues: all that the branch says is linked into the chain,
/// whether or not it changes anything.
world::Digest128 chain_of_branch(const world::Digest128& parent, const world::BranchT& branch);

/// What tick `index` continues; `last` is the chain of the tick before it.
world::Digest128 chain_before(const world::EpisodeT& episode,
                              std::uint64_t index,
                              const world::Digest128& last);

}  // namespace reprise::replay
