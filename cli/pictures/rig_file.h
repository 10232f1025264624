#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "world/external/rig.h"

namespace reprise::cli {

/// Sensors that a user has written down, for a trace in which nobody carried them.
struct RigFile {
    world::Rig rig;  ///< since tick 0, so that a sensor looks in each tick that its period divides
    std::vector<std::string> carriers;  ///< of each: an actor's name or id, "world", or "" as usual
};

/// Reads a rig of JSON, see docs/rendering.md. `step_ns`: how long a tick takes. Throws
/// world::Error with the file and the place in it.
RigFile read_rig_file(const std::filesystem::path& path, std::uint64_t step_ns);

}  // namespace reprise::cli
