#pragma once

#include <cstdint>
#include <string>

#include "replay/trace_reader.h"

namespace reprise::cli {

struct TickRange {
    std::uint64_t first = 1;
    std::uint64_t last = 0;  ///< included; below first: none
};

/// "A..B", "A..", "..B" or "A", ticks or times; "": all. What lies outside of the trace is cut off;
/// throws world::Error when nothing is left.
TickRange parse_ticks(const std::string& option,
                      const std::string& text,
                      const replay::TraceReader& trace);

}  // namespace reprise::cli
