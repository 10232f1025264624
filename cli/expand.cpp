#include "cli/expand.h"

#include <fmt/format.h>

#include "cli/guard.h"
#include "cli/other_build.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/reproduce.h"
#include "cli/self_test.h"
#include "cli/this_build.h"
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
