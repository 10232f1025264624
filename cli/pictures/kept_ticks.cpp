#include "cli/pictures/kept_ticks.h"

namespace reprise::cli {

KeptTicks::KeptTicks(replay::TraceReader& trace, std::uint64_t index, bool with_neighbours)
    : tick(trace.tick(index)) {
    if (with_neighbours && index > trace.first())
        last.emplace(trace.tick(index - 1));
    if (with_neighbours && index < trace.last())
        next.emplace(trace.tick(index + 1));
}

}  // namespace reprise::cli
