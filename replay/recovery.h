#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "world/check.h"
#include "world/recording.h"

namespace reprise::replay {

/// What became of a trace that was cut off or damaged.
struct Recovery {
    world::EpisodeT episode;
    world::Outcome
        outcome;       ///< of the trace that was written; verdict "error" when its end was lost
    std::string loss;  ///< what is not in it and why, or "" when everything is
};

/// The file can be read, but nothing in it can be used.
class NothingToRecover : public world::Error {
  public:
    using world::Error::Error;
};

/// Writes a whole trace of all ticks of `damaged` up to the first that is not sound, with a new
/// index: a trace has no holes. What lost nothing but its index comes out as it was recorded, byte
/// for byte. Every checksum is verified, and every tick's digest chain. Throws NothingToRecover,
/// and world::Error when a path is wrong or OUT cannot be written; nothing is left of OUT then.
/// OUT grows as OUT.recovered.partial: `damaged` may be OUT.partial.
Recovery recover(const std::filesystem::path& damaged, const std::filesystem::path& out);

}  // namespace reprise::replay
