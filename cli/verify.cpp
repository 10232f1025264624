#include "cli/verify.h"

#include <fmt/format.h>

#include "cli/fingerprint/self_test.h"
#include "cli/process/guard.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "cli/run_again.h"
#include "kernel/verify.h"
#include "replay/trace_format.h"
#include "replay/trace_reader.h"
#include "world/digest.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

/// What a part of a run cannot show; "" of a whole one.
std::string unseen(const replay::TraceReader& trace) {
    std::string what;
    if (trace.outcome() == world::outcome_of_part(trace.ticks()))
        what = fmt::format("how the run went on behind tick {} to tick {}, and how it ended",
                           trace.last(),
                           trace.run_ticks());
    else if (trace.outcome() == world::outcome_of_cut_off(trace.ticks()))
        what =
            fmt::format("how the run went on behind tick {}, where it was cut off", trace.last());
    const auto& branches = trace.episode().branches;
    if (!branches.empty() && branches.back().tick >= trace.last())
        what += fmt::format(", its branch at tick {}", branches.back().tick);
    return what;
}

}  // namespace

int verify(const VerifyOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    require_repeatable(trace);
    if (!options.expect.empty() &&
        !(trace.chain(trace.last()) == replay::format::from_hex(options.expect))) {
        fmt::print("{}: differs: its chain is {}, not {}: another run, or one that was changed\n",
                   options.trace,
                   world::to_hex(trace.chain(trace.last())),
                   options.expect);
        return exit_differs;
    }
    print_recording_build(trace);
    Progress progress("verifying", "ticks", trace.ticks());
    const auto divergence = kernel::verify(
        trace, [&](const world::SealedTick& tick) { progress.update(tick.view().index()); });
    progress.clear();
    if (divergence)
        return report_difference(options.trace, trace, *divergence, "");
    say("{}: equal at every one of {}, chain {} ({:.2f} s)\n",
        options.trace,
        world::count_of(trace.ticks(), "tick"),
        trace.ticks() == 0 ? "-" : world::to_hex(trace.chain(trace.last())),
        progress.seconds());
    if (const std::string what = unseen(trace); !what.empty())
        say("  unseen    {}\n", what);
    return exit_good;
}

}  // namespace reprise::cli
