#include "cli/slice.h"

#include <fmt/format.h>

#include "cli/guard.h"
#include "cli/output.h"
#include "cli/tick_range.h"
#include "replay/slice.h"

namespace reprise::cli {

int slice(const SliceOptions& options) {
    refuse_overwriting(options.trace, options.output);
    replay::TraceReader trace(options.trace);
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    replay::slice(trace, range.first, range.last, options.output);
    fmt::print("{}: ticks {} to {} of {}{}\n",
               options.output,
               range.first,
               range.last,
               trace.run_ticks(),
               range.first > 1 ? "; it cannot be verified from its middle" : "");
    return exit_good;
}

int merge(const MergeOptions& options) {
    for (const std::string& trace : options.traces)
        refuse_overwriting(trace, options.output);
    replay::TraceReader earlier(options.traces[0]);
    replay::TraceReader later(options.traces[1]);
    replay::merge(earlier, later, options.output);
    const bool whole = earlier.first() == 1 && later.last() == earlier.run_ticks();
    fmt::print("{}: ticks {} to {} of {}{}\n",
               options.output,
               earlier.first(),
               later.last(),
               earlier.run_ticks(),
               whole ? ", the whole run as it was recorded" : "");
    return exit_good;
}

}  // namespace reprise::cli
