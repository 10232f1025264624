#include "replay/imported.h"

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::replay {

bool is_imported(const TraceReader& trace) {
    return !trace.episode().imported_from.empty();
}

void require_simulated(const TraceReader& trace) {
    if (is_imported(trace))
        throw world::Error(
            fmt::format("{}: imported from {}: it holds poses only, and cannot be simulated again",
                        trace.path().string(),
                        trace.episode().imported_from));
}

}  // namespace reprise::replay
