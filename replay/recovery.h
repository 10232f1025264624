#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "replay/recording.h"

namespace reprise::replay {

/// What became of a trace that was cut off or damaged.
struct Recovery {
    Outcome outcome;   ///< of the trace that was written; verdict "error" when its end was lost
    std::string loss;  ///< what is not in it, or "" when everything is
};

/// Writes a whole trace of all ticks of `damaged` up to the first that is not sound, with a new
/// index. What lost nothing but its index comes out as it was recorded, byte for byte. Every
/// checksum is verified, and every tick's digest chain. Throws world::Error when nothing can be
/// used (its start is damaged), or when OUT cannot be written; nothing is written then.
Recovery recover(const std::filesystem::path& damaged, const std::filesystem::path& out);

}  // namespace reprise::replay
