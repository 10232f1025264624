#pragma once

#include <string>

#include "replay/compare/divergence.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// What `verify`, `expand` and `branch` have in common: a kernel goes a recorded way again.
/// Throws world::Error when the trace holds nothing that could be run from its beginning.
void require_repeatable(const replay::TraceReader& trace);

/// Says when another build recorded it, and in which lines that differs from this one.
void print_recording_build(const replay::TraceReader& trace);

/// Says that the second way differs, where, and how to see it again. Returns the exit code. `path`
/// as the user wrote it; `where` such as " before tick 5", or empty.
int report_difference(const std::string& path,
                      const replay::TraceReader& trace,
                      replay::Divergence divergence,
                      const std::string& where);

}  // namespace reprise::cli
