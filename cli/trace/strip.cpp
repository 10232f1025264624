#include "cli/trace/strip.h"

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "replay/imported.h"
#include "replay/level.h"
#include "replay/slice.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

double megabytes(const std::string& path) {
    return static_cast<double>(std::filesystem::file_size(path)) / 1e6;
}

}  // namespace

int strip(const StripOptions& options) {
    replay::TraceReader trace(options.trace);
    refuse_overwriting(options.trace, options.output);
    const replay::Level level = *replay::level_named(options.level);
    if (trace.level() < level)
        throw world::Error(replay::lacks_text(options.trace, trace.level()));
    replay::require_simulated(trace);  // expand could not bring anything back
    if (level == replay::Level::inputs)
        replay::require_start_of_run(trace);  // nothing could be made of such inputs
    replay::TraceWriter stripped(
        options.output, trace.recording(), level, replay::Unfinished::remove, trace.slice());
    Progress progress("stripping", "ticks", trace.ticks());
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index) {
        stripped.append(trace.recorded(index));
        progress.update(index + 1 - trace.first());
    }
    progress.clear();
    stripped.close(trace.outcome());
    say("{}: {} at level {}, {:.2f} MB of {:.2f} MB\n",
        options.output,
        world::count_of(trace.ticks(), "tick"),
        options.level,
        megabytes(options.output),
        megabytes(options.trace));
    return exit_good;
}

}  // namespace reprise::cli
