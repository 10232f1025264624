#pragma once

#include <cstdint>
#include <string>

#include "replay/trace_reader.h"

namespace reprise::replay {

/// How much of a table (see replay/table/table.h) is in a trace of some level.
enum class Kept : std::uint8_t {
    nothing,
    part,  ///< traffic once a second; of inputs: what was driven by hand, index and digests
    all
};

Kept kept(Level level, const std::string& table);

/// Throws world::Error, one line that says how to get it, when nothing of that table is there.
void require_kept(const TraceReader& trace, const std::string& table);

}  // namespace reprise::replay
