#include "cli/verify.h"

#include <fmt/format.h>

#include "cli/fingerprint/self_test.h"
#include "cli/process/guard.h"
#include "cli/process/progress.h"
#include "cli/run_again.h"
#include "kernel/verify.h"
#include "replay/trace_reader.h"
#include "world/digest.h"

namespace reprise::cli {

int verify(const TraceOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    require_repeatable(trace);
    print_recording_build(trace);
    Progress progress("verifying", "ticks", trace.ticks());
    const auto divergence = kernel::verify(
        trace, [&](const world::SealedTick& tick) { progress.update(tick.view().index()); });
    progress.clear();
    if (divergence)
        return report_difference(options.trace, trace, *divergence, "");
    fmt::print("{}: equal at every one of {} ticks, chain {} ({:.2f} s)\n",
               options.trace,
               trace.ticks(),
               trace.ticks() == 0 ? "-" : world::to_hex(trace.chain(trace.ticks())),
               progress.seconds());
    return exit_good;
}

}  // namespace reprise::cli
