#include "cli/expand.h"

#include <fmt/format.h>

#include "cli/fingerprint/other_build.h"
#include "cli/fingerprint/self_test.h"
#include "cli/fingerprint/this_build.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/reproduce.h"
#include "kernel/verify.h"
#include "replay/imported.h"
#include "replay/slice.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"

namespace reprise::cli {

int expand(const ExpandOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    replay::require_simulated(trace);
    replay::require_start_of_run(trace);
    refuse_overwriting(options.trace, options.output);
    print_other_build("another build recorded this",
                      "recorded",
                      trace.episode().fingerprint,
                      "here",
                      this_build());
    replay::TraceWriter full(options.output,
                             trace.recording(),
                             replay::Level::full,
                             replay::Unfinished::remove,
                             trace.slice());
    Progress progress("expanding", "ticks", trace.ticks());
    auto divergence = kernel::verify(trace, [&](const world::SealedTick& tick) {
        full.append(tick);
        progress.update(tick.view().index());
    });
    progress.clear();
    if (divergence) {
        divergence->again = "reprise verify " + shell_path(options.trace);
        fmt::print("{}: differs; nothing was written\n{}",
                   options.trace,
                   to_text(*divergence, trace.episode().step_ns));
        return exit_differs;
    }
    full.close(trace.outcome());
    fmt::print("{}: {} ticks, equal to those of {} ({:.2f} s)\n",
               options.output,
               trace.ticks(),
               options.trace,
               progress.seconds());
    return exit_good;
}

}  // namespace reprise::cli
