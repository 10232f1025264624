#pragma once

#include <cstdint>
#include <string>

#include "replay/trace_reader.h"

namespace reprise::exchange {

struct PageOptions {
    std::uint64_t first = 1;
    std::uint64_t last = 0;
    std::uint64_t every = 0;  ///< ticks; 0: all, of long runs so many that the page stays small
    /// How many that is: actors times ticks. Three million are about 4 MB of traffic in a town.
    std::uint64_t most_places = 3'000'000;
};

/// A trace to watch in a browser.
struct ReplayPage {
    std::string html;  ///< whole: needs no other file and no network
    std::uint64_t every =
        1;  ///< ticks from one drawn place to the next; between, it is interpolated
};

/// Reads the ticks once, about 30 us each with 100 cars. Throws world::Error for a trace of inputs
/// only, and as the reader does.
ReplayPage replay_page(replay::TraceReader& trace, const PageOptions& options);

}  // namespace reprise::exchange
