#include "cli/verify.h"

#include <fmt/format.h>

#include "cli/full_fingerprint.h"
#include "cli/guard.h"
#include "cli/other_build.h"
#include "cli/progress.h"
#include "cli/reproduce.h"
#include "cli/self_test.h"
#include "kernel/verify.h"
#include "replay/trace_reader.h"
#include "world/digest.h"

namespace reprise::cli {

namespace {

replay::Fingerprint this_build() {
    replay::Fingerprint lines;
    for (const auto& [key, value] : full_fingerprint()) {
        lines.emplace_back();
        lines.back().key = key;
        lines.back().value = value;
    }
    return lines;
}

}  // namespace

int verify(const TraceOptions& options) {
    self_test();
    replay::TraceReader trace(options.trace);
    print_other_build("another build recorded this",
                      "recorded",
                      trace.episode().fingerprint,
                      "here",
                      this_build());
    Progress progress("verifying", "ticks", trace.ticks());
    auto divergence = kernel::verify(trace, [&](std::uint64_t tick) { progress.update(tick); });
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
