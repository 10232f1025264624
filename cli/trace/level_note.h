#pragma once

#include "replay/trace_reader.h"

namespace reprise::cli {

/// On the standard error: that of what was asked for the trace holds a part only, and how to get
/// the rest. Nothing for a full trace.
void print_level_note(const replay::TraceReader& trace);

}  // namespace reprise::cli
