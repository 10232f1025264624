#include "cli/diff.h"

#include <fmt/format.h>

#include "cli/guard.h"
#include "replay/divergence.h"
#include "replay/trace_reader.h"
#include "world/digest.h"

namespace reprise::cli {

int diff(const DiffOptions& options) {
    replay::TraceReader expected(options.expected);
    replay::TraceReader found(options.found);
    const auto divergence = replay::compare(expected, found);
    if (!divergence) {
        fmt::print("equal: {} ticks, chain {}\n",
                   expected.ticks(),
                   world::to_hex(expected.chain(expected.ticks())));
        return exit_good;
    }
    fmt::print("different\n{}", to_text(*divergence, expected.episode().step_ns));
    return exit_differs;
}

}  // namespace reprise::cli
