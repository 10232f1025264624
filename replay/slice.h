#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "replay/trace_reader.h"

namespace reprise::replay {

/// Writes ticks `first` to `last` of a trace as a trace: with town, scenario and all, to be read,
/// played and rendered. Only one that begins at tick 1 can be verified. All ticks of a whole trace:
/// the trace again, byte for byte. It keeps the trace's level; throws world::Error, one line, for
/// one of level inputs that would begin later: nothing could be made of it.
void slice(TraceReader& trace,
           std::uint64_t first,
           std::uint64_t last,
           const std::filesystem::path& out);

/// Joins slices of one run and level, at least two, of which each goes on where another ends; that
/// they do is shown by their chains. In any order: they are sorted by their ticks. When no tick of
/// the run is missing it comes out as it was recorded, byte for byte. Throws world::Error, one line
/// that says what does not fit and which ticks are missing or in two of them, otherwise.
void merge(std::vector<TraceReader>& parts, const std::filesystem::path& out);

/// Throws world::Error for a slice that does not begin at tick 1: a run can only be simulated from
/// its start.
void require_start_of_run(const TraceReader& trace);

}  // namespace reprise::replay
