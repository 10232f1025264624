#include "cli/expand.h"

#include <fmt/format.h>

#include "cli/fingerprint/self_test.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "cli/run_again.h"
#include "kernel/verify.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "world/story/wording.h"

namespace reprise::cli {

int expand(const ExpandOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    require_repeatable(trace);
    refuse_overwriting(options.trace, options.output);
    print_recording_build(trace);
    replay::TraceWriter full(options.output,
                             trace.recording(),
                             replay::Level::full,
                             replay::Unfinished::remove,
                             trace.slice());
    Progress progress("expanding", "ticks", trace.ticks());
    const auto divergence = kernel::verify(trace, [&](const world::SealedTick& tick) {
        full.append(tick);
        progress.update(tick.view().index());
    });
    progress.clear();
    if (divergence)
        return report_difference(options.trace, trace, *divergence, "; nothing was written");
    full.close(trace.outcome());
    say("{}: {}, equal to those of {} ({:.2f} s)\n",
        options.output,
        world::count_of(trace.ticks(), "tick"),
        options.trace,
        progress.seconds());
    return exit_good;
}

}  // namespace reprise::cli
