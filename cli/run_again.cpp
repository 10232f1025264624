#include "cli/run_again.h"

#include <fmt/format.h>

#include "cli/fingerprint/other_build.h"
#include "cli/fingerprint/this_build.h"
#include "cli/process/guard.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "replay/imported.h"
#include "replay/slice.h"

namespace reprise::cli {

void require_repeatable(const replay::TraceReader& trace) {
    replay::require_simulated(trace);
    replay::require_start_of_run(trace);
}

void print_recording_build(const replay::TraceReader& trace) {
    print_other_build("another build recorded this",
                      "recorded",
                      trace.episode().fingerprint,
                      "here",
                      this_build());
}

int report_difference(const std::string& path,
                      const replay::TraceReader& trace,
                      replay::Divergence divergence,
                      const std::string& where) {
    divergence.again = "reprise verify " + shell_path(path);
    say("{}: differs{}\n", path, where);
    say_lines(to_text(divergence, trace.episode().step_ns));
    return exit_differs;
}

}  // namespace reprise::cli
