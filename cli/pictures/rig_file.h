#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "replay/trace_reader.h"
#include "world/external/rig.h"

namespace reprise::cli {

/// Sensors that a user has written down, for a trace in which nobody carried them.
struct RigFile {
    world::Rig rig;  ///< since tick 0, so that a sensor looks in each tick that its period divides
    std::vector<std::string> carriers;  ///< of each: an actor's name or id, "world", or "" as usual
    std::vector<std::optional<std::uint32_t>> carrier_ids;  ///< 0: the world; none: as usual
};

/// Reads a rig of JSON for this trace, see docs/rendering.md. Throws world::Error with the file and
/// the place in it.
RigFile read_rig_file(const std::filesystem::path& path, replay::TraceReader& trace);

/// Its cameras are rendered, the others are measured, each with what belongs to it.
RigFile only(RigFile file, bool cameras);

}  // namespace reprise::cli
