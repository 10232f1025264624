#pragma once

#include <cstdint>
#include <string>

#include "replay/trace_reader.h"

namespace reprise::replay {

/// The id of the actor of that name, or with that id. Reads from the start up to where the actor
/// appears. Throws world::Error when none does, with a suggestion.
std::uint32_t find_actor(TraceReader& trace, const std::string& name_or_id);

}  // namespace reprise::replay
