#include "cli/verify.h"

#include <fmt/format.h>
#include <map>

#include "cli/full_fingerprint.h"
#include "cli/guard.h"
#include "cli/self_test.h"
#include "cli/progress.h"
#include "kernel/verify.h"
#include "replay/trace_reader.h"
#include "world/digest.h"

namespace reprise::cli {

namespace {

/// Names each line in which this build differs from the one that recorded the trace: with another
/// build, equal bytes are not promised.
void print_other_build(const world::EpisodeT& episode) {
    std::map<std::string, std::string> recorded;
    for (const world::ParameterT& line : episode.fingerprint)
        recorded[line.key] = line.value;
    bool other = false;
    for (const auto& [key, value] : full_fingerprint()) {
        if (recorded[key] == value)
            continue;
        if (!other)
            fmt::print("another build recorded this; equal bytes are not promised\n");
        other = true;
        fmt::print("  {:<13}recorded {}, here {}\n", key, recorded[key], value);
    }
}

}  // namespace

int verify(const TraceOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    print_other_build(trace.episode());
    Progress progress("verifying", "ticks", trace.ticks());
    const auto divergence =
        kernel::verify(trace, [&](std::uint64_t tick) { progress.update(tick); });
    progress.clear();
    if (divergence) {
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
