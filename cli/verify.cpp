#include "cli/verify.h"

#include <fmt/format.h>

#include "cli/fingerprint/other_build.h"
#include "cli/fingerprint/self_test.h"
#include "cli/fingerprint/this_build.h"
#include "cli/process/guard.h"
#include "cli/process/progress.h"
#include "cli/process/reproduce.h"
#include "kernel/verify.h"
#include "replay/imported.h"
#include "replay/slice.h"
#include "replay/trace_reader.h"
#include "world/digest.h"

namespace reprise::cli {

int verify(const TraceOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    replay::require_simulated(trace);
    replay::require_start_of_run(trace);
    print_other_build("another build recorded this",
                      "recorded",
                      trace.episode().fingerprint,
                      "here",
                      this_build());
    Progress progress("verifying", "ticks", trace.ticks());
    auto divergence = kernel::verify(
        trace, [&](const world::SealedTick& tick) { progress.update(tick.view().index()); });
    progress.clear();
    if (divergence) {
        divergence->again = "reprise verify " + shell_path(options.trace);
        fmt::print("{}: differs\n{}", options.trace, to_text(*divergence, trace.episode().step_ns));
        return exit_differs;
    }
    fmt::print("{}: equal at every one of {} ticks, chain {} ({:.2f} s)\n",
               options.trace,
               trace.ticks(),
               trace.ticks() == 0 ? "-" : world::to_hex(trace.chain(trace.ticks())),
               progress.seconds());
    return exit_good;
}

}  // namespace reprise::cli
