#pragma once

#include <cstdint>
#include <optional>

#include "replay/trace_reader.h"
#include "world/external/rig.h"

namespace reprise::cli {

/// What a vehicle carried in a recorded run: of `actor`, or of the first that carried anything
/// (actor 0). Looks at the ticks up to `last`; of a slice also at who was there before it. Throws
/// world::Error for a rig that is not possible.
std::optional<world::Rig> recorded_rig(replay::TraceReader& trace,
                                       std::uint32_t actor,
                                       std::uint64_t last);

}  // namespace reprise::cli
