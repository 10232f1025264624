#include "cli/trace/slice.h"

#include <fmt/format.h>

#include "cli/options/tick_range.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/say.h"
#include "replay/slice.h"
#include "world/check.h"

namespace reprise::cli {

int slice(const SliceOptions& options) {
    refuse_overwriting(options.trace, options.output);
    replay::TraceReader trace(options.trace);
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    replay::slice(trace, range.first, range.last, options.output);
    say("{}: ticks {} to {} of {}{}\n",
        options.output,
        range.first,
        range.last,
        trace.run_ticks(),
        range.first > 1 ? "; it cannot be verified from its middle" : "");
    return exit_good;
}

int merge(const MergeOptions& options) {
    if (options.traces.size() < 2)
        throw world::Error("merge: expected two slices or more");
    std::vector<replay::TraceReader> parts;
    for (const std::string& trace : options.traces) {
        refuse_overwriting(trace, options.output);
        parts.emplace_back(trace);
    }
    replay::merge(parts, options.output);  // sorts them
    const std::uint64_t first = parts.front().first();
    const std::uint64_t last = parts.back().last();
    const std::uint64_t run_ticks = parts.front().run_ticks();
    say("{}: ticks {} to {} of {}{}\n",
        options.output,
        first,
        last,
        run_ticks,
        first == 1 && last == run_ticks ? ", the whole run as it was recorded" : "");
    return exit_good;
}

}  // namespace reprise::cli
