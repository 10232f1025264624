#pragma once

#include "replay/trace_reader.h"

namespace reprise::replay {

/// Was this run recorded by another simulator? Then the trace holds poses only.
bool is_imported(const TraceReader& trace);

/// Throws world::Error, one line, for an imported trace: there is nothing in it to simulate from.
void require_simulated(const TraceReader& trace);

}  // namespace reprise::replay
